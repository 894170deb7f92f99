#include "analysis/figures/internal/module_grid.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "analysis/drawing/axes.h"
#include "analysis/drawing/figure_style.h"
#include "analysis/figures/internal/panel_grid.h"
#include "base/plain_text.h"

namespace swarmsmith {
namespace {

constexpr double kCellHeight = 4.1;
constexpr double kLeastCell = 6.6;
constexpr double kMostCell = 16;
constexpr double kNumberSize = 2.3;
constexpr double kNameSize = 2.5;
constexpr double kNameRoom = 3.2;  ///< height of a line of methods' names
constexpr double kBeforeCell = 1.5;
constexpr double kMostLabel = 24;
constexpr double kSmallGap = 3;
constexpr std::string_view kShade = "#0072b2";
constexpr double kDarkest = 0.3;  ///< lightened towards white, so that letters stay readable

using Cells = std::vector<std::optional<ModuleCounts>>;

/// The names of a grid's columns, and their cells.
struct MissionGrid {
  std::string mission;
  std::vector<std::pair<std::string, Cells>> methods;
  std::vector<std::size_t> designs;
};

std::vector<MissionGrid> grids_of(const ModuleChart& chart) {
  std::vector<MissionGrid> grids;
  for (const ModuleChart::Block& block : chart.blocks) {
    for (const ModuleChart::Column& column : block.columns) {
      auto grid = std::ranges::find(grids, column.mission, &MissionGrid::mission);
      if (grid == grids.end()) grid = grids.insert(grids.end(), {.mission = column.mission});
      grid->methods.emplace_back(block.method, column.cells);
      grid->designs.push_back(column.designs);
    }
  }
  std::ranges::sort(grids, {}, &MissionGrid::mission);
  return grids;
}

/// "n = 10", or the range if the numbers differ.
std::string designs_text(const MissionGrid& grid) {
  const auto [least, most] = std::ranges::minmax(grid.designs);
  return least == most ? fmt::format("n = {}", least) : fmt::format("n = {} to {}", least, most);
}

class GridDrawing {
 public:
  explicit GridDrawing(const ModuleChart& chart)
      : chart_(chart),
        grids_(grids_of(chart)),
        places_(grids_.size(), least_width(), chart.width_mm) {
    std::size_t most = 1;
    for (const MissionGrid& grid : grids_)
      most = std::max(most, grid.methods.size());
    cell_ =
        std::min((places_.width() - label() - kBeforeCell) / static_cast<double>(most), kMostCell);
    // Names are on alternating lines, as many as needed to keep them apart.
    while (static_cast<double>(levels_) * cell_ < widest_method() + 1)
      ++levels_;
  }

  std::string svg() const {
    const double top = kMargin + (chart_.title.empty() ? 0 : kTitleSize) +
                       kLineHeight * static_cast<double>(chart_.details.size()) + 2;
    const auto explanation = broken_text(chart_.explained ? explained() : "", kTextSize,
                                         chart_.width_mm - 2 * kMargin, 8);
    const double bottom = top + height() * static_cast<double>(places_.rows());
    Svg svg(chart_.width_mm,
            bottom + kLineHeight * static_cast<double>(explanation.size()) + kMargin, chart_.title,
            fmt::format("Grids of {} by method, one a mission",
                        counted(chart_.modules.size(), "module")));
    draw_heading(svg, chart_.title, chart_.details);
    for (std::size_t i = 0; i < grids_.size(); ++i)
      draw_grid(svg, grids_[i], places_.left_of(i),
                top + height() * static_cast<double>(places_.row_of(i)));
    for (std::size_t i = 0; i < explanation.size(); ++i)
      svg.text({kMargin, bottom + kLineHeight * static_cast<double>(i) + kTextSize}, explanation[i],
               ink(TextStyle::Anchor::Start));
    return svg.finish();
  }

 private:
  double label() const {
    double widest = 0;
    for (const std::string& module : chart_.modules)
      widest = std::max(widest, text_width(module, kNameSize));
    return std::min(widest, kMostLabel);
  }
  double widest_method() const {
    double widest = 0;
    for (const ModuleChart::Block& block : chart_.blocks)
      widest = std::max(widest, text_width(block.method, kNameSize));
    return widest;
  }
  double least_width() const {
    std::size_t most = 1;
    for (const MissionGrid& grid : grids_)
      most = std::max(most, grid.methods.size());
    return label() + kBeforeCell + kLeastCell * static_cast<double>(most);
  }
  double head() const { return kLineHeight + kNameRoom * static_cast<double>(levels_) + 1; }
  double height() const {
    return head() + kCellHeight * static_cast<double>(chart_.modules.size()) + kSmallGap;
  }
  std::string explained() const {
    std::string text =
        "Number: occurrences in a machine, on average; shade: share of the machines that have the "
        "module, from 0 (white) to 100 % (dark); n: machines per column, the winners of finished "
        "designs";
    const auto lacks = [](const ModuleChart::Column& column) {
      return std::ranges::any_of(column.cells, [](const auto& cell) { return !cell; });
    };
    const bool any = std::ranges::any_of(chart_.blocks, [&](const ModuleChart::Block& block) {
      return std::ranges::any_of(block.columns, lacks);
    });
    return any ? text + "; -: the flavour has no such module" : text;
  }

  void draw_grid(Svg& svg, const MissionGrid& grid, double left, double top) const {
    const double first = left + label() + kBeforeCell;
    TextStyle bold = ink(TextStyle::Anchor::Start);
    bold.bold = true;
    svg.text({left, top + kTextSize},
             fitted_text(grid.mission, kTextSize * kBolder, places_.width()), bold);
    const double cells = top + head();
    svg.text({left, cells - 1.5}, designs_text(grid), ink(TextStyle::Anchor::Start, kNameSize));
    for (std::size_t m = 0; m < grid.methods.size(); ++m) {
      const double x = first + cell_ * (static_cast<double>(m) + 0.5);
      draw_name(svg, grid.methods[m].first, m, x, cells, left + places_.width());
      draw_column(svg, grid.methods[m].second, x, cells);
    }
    for (std::size_t row = 0; row < chart_.modules.size(); ++row) {
      const auto lines = whole_lines(chart_.modules[row], kNameSize, label() + 0.01);
      const double size = lines.size() > 1 ? 2.0 : kNameSize;
      double y = cells + kCellHeight * (static_cast<double>(row) + 0.5) + 0.36 * size -
                 size * static_cast<double>(lines.size() - 1) / 2;
      for (const std::string& line : lines) {
        svg.text({first - kBeforeCell, y}, line, ink(TextStyle::Anchor::End, size));
        y += size;
      }
    }
  }

  /// Draws the name above its column, on a separate line from its neighbours if they are too close.
  void draw_name(Svg& svg, const std::string& name, std::size_t number, double x, double cells,
                 double right) const {
    const std::size_t level = levels_ - 1 - number % levels_;
    const double y = cells - 1 - kNameRoom * static_cast<double>(level);
    const double half = text_width(name, kNameSize) / 2;
    const double at = std::min(x, right - half);
    svg.text({at, y - 0.3}, name, ink(TextStyle::Anchor::Middle, kNameSize));
    if (level == 0) return;
    const std::array<PagePoint, 2> line = {PagePoint{x, y + 0.3}, PagePoint{x, cells - 0.3}};
    svg.line(line, stroked("#bbbbbb", 0.15));
  }

  void draw_column(Svg& svg, const Cells& cells, double x, double top) const {
    for (std::size_t row = 0; row < cells.size(); ++row) {
      const double y = top + kCellHeight * static_cast<double>(row);
      const double half = cell_ / 2 - 0.15;
      const std::array<PagePoint, 4> box = {{{x - half, y + 0.15},
                                             {x + half, y + 0.15},
                                             {x + half, y + kCellHeight - 0.15},
                                             {x - half, y + kCellHeight - 0.15}}};
      const double share = cells[row] ? cells[row]->occurrence_rate : 0;
      svg.polygon(box, filled(lightened(std::string(kShade), 1 - (1 - kDarkest) * share)));
      const std::string number =
          cells[row] ? fmt::format("{:.1f}", cells[row]->average_occurrences) : "-";
      svg.text({x, y + kCellHeight / 2 + 0.36 * kNumberSize}, number,
               ink(TextStyle::Anchor::Middle, kNumberSize));
    }
  }

  const ModuleChart& chart_;
  std::vector<MissionGrid> grids_;
  PanelGrid places_;
  double cell_ = kLeastCell;
  std::size_t levels_ = 1;
};

}  // namespace

std::string draw_module_grid(const ModuleChart& chart) {
  return GridDrawing(chart).svg();
}

}  // namespace swarmsmith
