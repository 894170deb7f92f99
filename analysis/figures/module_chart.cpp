#include "analysis/figures/module_chart.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "analysis/drawing/axes.h"
#include "analysis/drawing/figure_style.h"
#include "analysis/figures/internal/module_grid.h"
#include "base/plain_text.h"

namespace swarmsmith {
namespace {

constexpr double kLabelSize = 2.5;
constexpr double kHeadingSize = 2.6;
constexpr double kNumberSize = 2.5;
constexpr double kLeastColumn = 17.6;  ///< for two numbers side by side, mm
constexpr double kGap = 1.5;           ///< between columns, and within a column
constexpr double kRow = 7.5;
constexpr double kBar = 1.5;
constexpr double kPage = 240;  ///< a higher chart becomes a grid
constexpr std::string_view kTrack = "#e8e8e8";
TextStyle ink_of_size(double size, TextStyle::Anchor anchor = TextStyle::Anchor::Start) {
  return {.size = size, .anchor = anchor, .fill = std::string(kInk)};
}

/// Columns that are side by side.
struct Stripe {
  const std::string* method = nullptr;
  std::span<const ModuleChart::Column> columns;
};

/// Positions and sizes in the chart.
struct ChartLayout {
  double label = 0;   ///< width of the modules' names
  double column = 0;  ///< width of a column, without the gap
  std::size_t columns = 1;
  double largest = 1;  ///< the average that fills a bar
  bool names_methods = false;
  std::size_t heading_lines = 1;

  double left_of(std::size_t column_number) const {
    return kMargin + label + kGap + static_cast<double>(column_number) * (column + kGap);
  }
  double heading() const {
    return kLineHeight * static_cast<double>(heading_lines + 2 + (names_methods ? 1 : 0)) + 1;
  }
};

ChartLayout layout_of(const ModuleChart& chart) {
  ChartLayout layout{.names_methods = chart.blocks.size() > 1};
  const double room = chart.width_mm - 2 * kMargin;
  for (const std::string& module : chart.modules) {
    // On two lines, broken so that the longer line is as short as possible.
    double shortest = text_width(module, kLabelSize);
    for (std::size_t blank = 0; (blank = module.find(' ', blank)) != std::string::npos; ++blank) {
      const std::string_view text = module;
      shortest = std::min(shortest, std::max(text_width(text.substr(0, blank), kLabelSize),
                                             text_width(text.substr(blank + 1), kLabelSize)));
    }
    layout.label = std::max(layout.label, shortest);
  }
  layout.label = std::min(layout.label, 0.4 * room);
  std::size_t most = 1;
  for (const auto& block : chart.blocks) {
    most = std::max(most, block.columns.size());
    for (const auto& column : block.columns)
      for (const auto& cell : column.cells)
        if (cell) layout.largest = std::max(layout.largest, cell->average_occurrences);
  }
  layout.columns = static_cast<std::size_t>((room - layout.label) / (kLeastColumn + kGap));
  layout.columns = std::clamp<std::size_t>(layout.columns, 1, most);
  layout.column =
      std::min((room - layout.label) / static_cast<double>(layout.columns) - kGap, 45.0);
  for (const auto& block : chart.blocks) {
    for (const auto& column : block.columns) {
      layout.heading_lines = std::max(
          layout.heading_lines, broken_text(column.mission, kHeadingSize, layout.column, 3).size());
    }
  }
  return layout;
}

/// An explanation of the numbers and bars, in lines.
std::vector<std::string> explanation_of(const ModuleChart& chart, const ChartLayout& layout) {
  std::string text = fmt::format(
      "mean: occurrences in a machine, on average, bars to {:.1f}; share: of the machines that "
      "have "
      "the module; n: machines, the winners of finished designs",
      layout.largest);
  const auto any = [&](auto is_such) {
    return std::ranges::any_of(chart.blocks, [&](const auto& block) {
      return std::ranges::any_of(block.columns, [&](const auto& column) {
        return std::ranges::any_of(column.cells, is_such);
      });
    });
  };
  if (any([](const auto& c) { return c && c->average_reachable < c->average_occurrences; }))
    text += "; pale: in states that cannot be reached";
  if (any([](const auto& c) { return !c; })) text += "; -: the flavour has no such module";
  if (!chart.explained) return {};
  return broken_text(text, kTextSize, chart.width_mm - 2 * kMargin, 8);
}

std::vector<Stripe> stripes_of(const ModuleChart& chart, const ChartLayout& layout) {
  std::vector<Stripe> stripes;
  for (const auto& block : chart.blocks) {
    const std::span<const ModuleChart::Column> all(block.columns);
    for (std::size_t first = 0; first < all.size(); first += layout.columns)
      stripes.push_back(
          {&block.method, all.subspan(first, std::min(layout.columns, all.size() - first))});
  }
  return stripes;
}

/// The bar's length is `all`, drawn pale; its part `reachable` is drawn in full colour.
void draw_bar(Svg& svg, PagePoint at, double width, double all, double reachable,
              const std::string& color) {
  const auto box = [&](double right) {
    return std::array<PagePoint, 4>{{at, {right, at.y}, {right, at.y + kBar}, {at.x, at.y + kBar}}};
  };
  constexpr double kPale = 0.6;
  svg.polygon(box(at.x + width), filled(kTrack));
  if (all > reachable) svg.polygon(box(at.x + width * all), filled(lightened(color, kPale)));
  if (reachable > 0) svg.polygon(box(at.x + width * reachable), filled(color));
}

void draw_cell(Svg& svg, PagePoint at, const ChartLayout& layout,
               const std::optional<ModuleCounts>& cell) {
  const double half = (layout.column - kGap) / 2;
  const double second = at.x + half + kGap;
  const std::string mean = cell ? fmt::format("{:.1f}", cell->average_occurrences) : "-";
  const std::string share = cell ? fmt::format("{:.0f} %", 100 * cell->occurrence_rate) : "-";
  svg.text({at.x, at.y + kTextSize}, mean, ink_of_size(kNumberSize));
  svg.text({second, at.y + kTextSize}, share, ink_of_size(kNumberSize));
  if (!cell) return;
  const double bar = at.y + kTextSize + 0.8;
  draw_bar(svg, {at.x, bar}, half, cell->average_occurrences / layout.largest,
           cell->average_reachable / layout.largest, distinct_color(0));
  draw_bar(svg, {second, bar}, half, cell->occurrence_rate, cell->reachable_rate,
           distinct_color(4));
}

/// Draws the mission, the number of designs, and a label for the numbers below.
void draw_heading_of(Svg& svg, const ModuleChart::Column& column, double left, double bottom,
                     const ChartLayout& layout) {
  const auto lines = broken_text(column.mission, kHeadingSize, layout.column, 3);
  double y = bottom - 1.5;
  svg.text({left, y}, "mean", ink_of_size(kTextSize));
  svg.text({left + (layout.column + kGap) / 2, y}, "share", ink_of_size(kTextSize));
  y -= kLineHeight;
  svg.text({left, y}, fmt::format("n = {}", column.designs), ink_of_size(kTextSize));
  for (std::size_t i = lines.size(); i-- > 0;) {
    y -= kLineHeight;
    svg.text({left, y}, lines[i], ink_of_size(kHeadingSize));
  }
}

void draw_labels(Svg& svg, const ModuleChart& chart, double top, const ChartLayout& layout) {
  for (std::size_t m = 0; m < chart.modules.size(); ++m) {
    const auto lines = broken_text(chart.modules[m], kLabelSize, layout.label + 0.01, 2);
    double y = top + kRow * static_cast<double>(m) + kTextSize + (lines.size() == 1 ? 1 : 0);
    for (const std::string& line : lines) {
      svg.text({kMargin, y}, line, ink_of_size(kLabelSize));
      y += kLabelSize + 0.5;
    }
  }
}

void draw_stripe(Svg& svg, const ModuleChart& chart, const Stripe& stripe, double top,
                 const ChartLayout& layout) {
  if (layout.names_methods) {
    TextStyle bold = ink_of_size(kTextSize);
    bold.bold = true;
    svg.text({kMargin, top + kTextSize},
             fitted_text(*stripe.method, kTextSize * kBolder, svg.width() - 2 * kMargin), bold);
  }
  const double first = top + layout.heading();
  draw_labels(svg, chart, first, layout);
  for (std::size_t c = 0; c < stripe.columns.size(); ++c) {
    const ModuleChart::Column& column = stripe.columns[c];
    draw_heading_of(svg, column, layout.left_of(c), first, layout);
    for (std::size_t m = 0; m < column.cells.size(); ++m) {
      draw_cell(svg, {layout.left_of(c), first + kRow * static_cast<double>(m)}, layout,
                column.cells[m]);
    }
  }
}

}  // namespace

std::string draw(const ModuleChart& chart) {
  const ChartLayout layout = layout_of(chart);
  const auto stripes = stripes_of(chart, layout);
  const double height = layout.heading() + kRow * static_cast<double>(chart.modules.size()) + 3;
  const auto explanation = explanation_of(chart, layout);
  const double top = kMargin + (chart.title.empty() ? 0 : kTitleSize) +
                     kLineHeight * static_cast<double>(chart.details.size()) + 2;
  const double bottom = top + height * static_cast<double>(stripes.size());
  if (chart.blocks.size() > 1 && bottom > kPage) return draw_module_grid(chart);
  Svg svg(chart.width_mm, bottom + kLineHeight * static_cast<double>(explanation.size()) + kMargin,
          chart.title,
          fmt::format("Table with bars: {} by mission", counted(chart.modules.size(), "module")));
  draw_heading(svg, chart.title, chart.details);
  for (std::size_t i = 0; i < stripes.size(); ++i)
    draw_stripe(svg, chart, stripes[i], top + height * static_cast<double>(i), layout);
  for (std::size_t i = 0; i < explanation.size(); ++i) {
    svg.text({kMargin, bottom + kLineHeight * static_cast<double>(i) + kTextSize}, explanation[i],
             ink_of_size(kTextSize));
  }
  return svg.finish();
}

}  // namespace swarmsmith
