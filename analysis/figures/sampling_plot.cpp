#include "analysis/figures/sampling_plot.h"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "analysis/drawing/axes.h"
#include "analysis/drawing/figure_style.h"
#include "analysis/drawing/legend.h"
#include "analysis/figures/internal/category_colors.h"

namespace swarmsmith {
namespace {

constexpr double kBetween = 3;  ///< panels
constexpr double kRatio = 0.62;
constexpr double kTallest = 40;
constexpr std::size_t kCaptionLines = 6;
constexpr std::string_view kFrame = "#999999";
/// Densities from which a shade begins, 1 being an even spread over the range.
constexpr std::array<double, 4> kDensities = {0, 1, 2, 4};
constexpr std::string_view kDensityColor = "#2c5f8a";

std::string density_color(std::size_t shade) {
  constexpr std::array<double, kDensities.size()> kPaleness = {0.85, 0.6, 0.3, 0};
  return lightened(std::string(kDensityColor), kPaleness[shade]);
}

TextStyle ink(TextStyle::Anchor anchor) {
  return {.size = kTextSize, .anchor = anchor, .fill = std::string(kInk)};
}

/// A number of at most five letters or so.
std::string end_text(double value) {
  return fmt::format("{:.4g}", value);
}

/// The ends of the values themselves: whole numbers have half of their part beyond.
double least(const SamplingPlot::Panel& panel) {
  return panel.is_whole ? panel.low + 0.5 : panel.low;
}
double largest(const SamplingPlot::Panel& panel) {
  return panel.is_whole ? panel.high - 0.5 : panel.high;
}

CategoryColors colors_of(const SamplingPlot& plot) {
  std::vector<std::vector<std::string>> lists;
  for (const auto& panel : plot.panels)
    lists.push_back(panel.categories);
  return CategoryColors(lists);
}

/// Draws one panel within its area.
class PanelDrawing {
 public:
  PanelDrawing(Svg& svg, const SamplingPlot::Panel& panel, const PlotArea& area)
      : svg_(svg),
        panel_(panel),
        area_(area),
        bands_(panel.columns.size(), area.left, area.right()) {
    thickness_ = bands_.width() < 1 ? bands_.width() : 0.9 * bands_.width();
  }

  void shares(const CategoryColors& colors) {
    for (std::size_t kind = 0; kind < panel_.categories.size(); ++kind) {
      std::vector<PageBar> bars;
      for (std::size_t column = 0; column < panel_.columns.size(); ++column) {
        const auto& counts = panel_.columns[column].counts;
        std::int64_t below = 0;
        for (std::size_t i = 0; i < kind; ++i)
          below += counts[i];
        const auto all =
            static_cast<double>(std::max<std::int64_t>(1, panel_.columns[column].candidates));
        if (counts[kind] == 0) continue;
        const double height = area_.height * static_cast<double>(counts[kind]) / all;
        const double bottom = area_.bottom() - area_.height * static_cast<double>(below) / all;
        bars.push_back({{bands_.centre(column), bottom - height}, height});
      }
      svg_.bars(bars, thickness_, colors.color(panel_.categories[kind]), BarDirection::Down);
    }
    ends("0", "1");
  }

  void densities() {
    for (std::size_t shade = 0; shade < kDensities.size(); ++shade) {
      std::vector<PageBar> bars;
      double height = 0;
      for (std::size_t column = 0; column < panel_.columns.size(); ++column) {
        const auto& counts = panel_.columns[column].counts;
        height = area_.height / static_cast<double>(counts.size());
        std::int64_t active = 0;
        for (const std::int64_t count : counts)
          active += count;
        for (std::size_t part = 0; part < counts.size(); ++part) {
          const double even = static_cast<double>(active) / static_cast<double>(counts.size());
          if (counts[part] == 0 || shade_of(static_cast<double>(counts[part]) / even) != shade)
            continue;
          const double y = area_.bottom() - height * (static_cast<double>(part) + 1);
          bars.push_back({{bands_.centre(column), y}, height});
        }
      }
      svg_.bars(bars, thickness_, density_color(shade), BarDirection::Down);
    }
    elites();
    ends(end_text(least(panel_)), end_text(largest(panel_)));
  }

  /// `slot` is where the panel begins, with its numbers at the left.
  void frame(double slot) {
    const std::array<PagePoint, 4> corners = {{{area_.left, area_.top},
                                               {area_.right(), area_.top},
                                               {area_.right(), area_.bottom()},
                                               {area_.left, area_.bottom()}}};
    svg_.polygon(corners, stroked(kFrame, 0.12));
    svg_.text({slot, area_.top - 1},
              fitted_text(panel_.name, kTextSize, area_.right() + kBetween - 1 - slot),
              ink(TextStyle::Anchor::Start));
  }

 private:
  static std::size_t shade_of(double density) {
    std::size_t shade = 0;
    while (shade + 1 < kDensities.size() && density > kDensities[shade + 1])
      ++shade;
    return shade;
  }

  void elites() {
    const Axis axis({panel_.low, panel_.high > panel_.low ? panel_.high : panel_.low + 1},
                    area_.bottom(), area_.top);
    std::vector<PageBar> marks;
    for (std::size_t column = 0; column < panel_.columns.size(); ++column) {
      const auto& values = panel_.columns[column].elites;
      for (const double value : std::set<double>(values.begin(), values.end())) {
        const double left = bands_.centre(column) - thickness_ / 2;
        marks.push_back({{left, axis.at(value)}, thickness_});
      }
    }
    svg_.bars(marks, 0.3, "#000000");
  }

  void ends(const std::string& low, const std::string& high) {
    svg_.text({area_.left - 0.8, area_.bottom()}, low, ink(TextStyle::Anchor::End));
    svg_.text({area_.left - 0.8, area_.top + 0.72 * kTextSize}, high, ink(TextStyle::Anchor::End));
  }

  Svg& svg_;
  const SamplingPlot::Panel& panel_;
  PlotArea area_;
  Bands bands_;
  double thickness_ = 0;
};

/// First and last iteration below a panel.
void draw_iterations(Svg& svg, const SamplingPlot& plot, const PlotArea& area) {
  if (plot.iterations.empty()) return;
  const double y = area.bottom() + 0.6 + kTextSize;
  svg.text({area.left, y}, fmt::format("{}", plot.iterations.front()),
           ink(TextStyle::Anchor::Start));
  if (plot.iterations.size() < 2) return;
  svg.text({area.right(), y}, fmt::format("{}", plot.iterations.back()),
           ink(TextStyle::Anchor::End));
}

/// A paragraph for each family of values, with the panels that have it, and one for numbers.
std::vector<FlowingLegend> legends_of(const SamplingPlot& plot, const CategoryColors& colors) {
  std::vector<std::vector<LegendEntry>> paragraphs;
  for (const auto& family : colors.families()) {
    std::string names;
    for (const auto& panel : plot.panels) {
      if (CategoryColors::belongs(panel.categories, family))
        names += (names.empty() ? "" : ", ") + panel.name;
    }
    auto& entries = paragraphs.emplace_back();
    entries.push_back({"", names + ":"});
    for (const auto& [value, color] : family)
      entries.push_back({color, value});
  }
  const bool has_numbers =
      std::ranges::any_of(plot.panels, [](const auto& panel) { return panel.categories.empty(); });
  if (has_numbers) {
    auto& entries = paragraphs.emplace_back();
    entries.push_back({"", "density, up to:"});
    for (std::size_t shade = 0; shade + 1 < kDensities.size(); ++shade)
      entries.push_back({density_color(shade), fmt::format("{:g}", kDensities[shade + 1])});
    entries.push_back({density_color(kDensities.size() - 1), "more"});
    entries.push_back({"#000000", "elites"});
  }
  std::vector<FlowingLegend> legends;
  legends.reserve(paragraphs.size());
  for (auto& entries : paragraphs)
    legends.emplace_back(std::move(entries), plot.width_mm - 2 * kMargin);
  return legends;
}

double head_of(const SamplingPlot& plot) {
  return kMargin + kTitleSize + kLineHeight * static_cast<double>(plot.details.size()) + 2;
}

/// Room for the numbers left of the panels.
double ends_room(const SamplingPlot& plot) {
  double widest = text_width("0", kTextSize);
  for (const auto& panel : plot.panels) {
    if (!panel.categories.empty()) continue;
    widest = std::max({widest, text_width(end_text(least(panel)), kTextSize),
                       text_width(end_text(largest(panel)), kTextSize)});
  }
  return widest + 1;
}

std::string description_of(const SamplingPlot& plot) {
  std::string names;
  for (const auto& panel : plot.panels)
    names += (names.empty() ? "" : ", ") + panel.name;
  return fmt::format("Values sampled by iteration, {} iterations, a panel each of {}. {}",
                     plot.iterations.size(), names, plot.caption);
}

}  // namespace

std::string draw(const SamplingPlot& plot) {
  const CategoryColors colors = colors_of(plot);
  const std::vector<FlowingLegend> legends = legends_of(plot, colors);
  double legends_height = 0;
  for (const FlowingLegend& legend : legends)
    legends_height += legend.height();
  const double width = plot.width_mm - 2 * kMargin;
  const std::vector<std::string> caption =
      broken_text(plot.caption, kTextSize, width, kCaptionLines);
  const std::size_t across =
      std::clamp<std::size_t>(plot.panels_a_line, 1, std::max<std::size_t>(1, plot.panels.size()));
  const auto lines = static_cast<double>((plot.panels.size() + across - 1) / across);
  const double room = ends_room(plot);
  const double pitch = (width + kBetween) / static_cast<double>(across);
  const double area_width = pitch - kBetween - room;
  const double area_height = std::min(kTallest, kRatio * (pitch - kBetween));
  const double line_height = kLineHeight + area_height + 0.6 + kLineHeight;
  const double head = head_of(plot);
  double legend_top = head + lines * line_height + kLineHeight + 1;
  const double caption_top = legend_top + legends_height + kTextSize;
  Svg svg(plot.width_mm,
          caption_top + kLineHeight * static_cast<double>(caption.size()) - kTextSize + kMargin,
          plot.title, description_of(plot));
  draw_heading(svg, plot.title, plot.details);
  for (std::size_t i = 0; i < plot.panels.size(); ++i) {
    const SamplingPlot::Panel& panel = plot.panels[i];
    const PlotArea area{.left = kMargin + room + pitch * static_cast<double>(i % across),
                        .top = head + kLineHeight + line_height * static_cast<double>(i / across),
                        .width = area_width,
                        .height = area_height};
    PanelDrawing drawing(svg, panel, area);
    if (panel.categories.empty()) {
      drawing.densities();
    } else {
      drawing.shares(colors);
    }
    drawing.frame(area.left - room);
    draw_iterations(svg, plot, area);
  }
  svg.text({kMargin, head + lines * line_height + kTextSize}, "from left to right: iterations",
           ink(TextStyle::Anchor::Start));
  for (const FlowingLegend& legend : legends) {
    legend.draw(svg, legend_top);
    legend_top += legend.height();
  }
  for (std::size_t i = 0; i < caption.size(); ++i) {
    svg.text({kMargin, caption_top + kLineHeight * static_cast<double>(i)}, caption[i],
             ink(TextStyle::Anchor::Start));
  }
  return svg.finish();
}

}  // namespace swarmsmith
