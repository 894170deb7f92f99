#include "analysis/figures/sampling_plot.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "analysis/drawing/axes.h"
#include "analysis/drawing/figure_style.h"
#include "analysis/drawing/legend.h"
#include "analysis/figures/internal/category_colors.h"
#include "analysis/figures/internal/sampling_panel.h"
#include "base/plain_text.h"

namespace swarmsmith {
namespace {

constexpr double kBetween = 3;  ///< between panels
constexpr double kSampleRatio = 0.62;
constexpr double kTallestPanel = 40;
constexpr std::size_t kMostCaptionLines = 6;

CategoryColors colors_of(const SamplingPlot& plot) {
  std::vector<std::vector<std::string>> lists;
  for (const auto& panel : plot.panels)
    lists.push_back(panel.categories);
  return CategoryColors(lists);
}

/// Writes the first and the last iteration below a panel.
void draw_iterations(Svg& svg, const SamplingPlot& plot, const PlotArea& area) {
  if (plot.iterations.empty()) return;
  const double y = area.bottom() + 0.6 + kTextSize;
  svg.text({area.left, y}, fmt::format("{}", plot.iterations.front()),
           ink(TextStyle::Anchor::Start));
  if (plot.iterations.size() < 2) return;
  svg.text({area.right(), y}, fmt::format("{}", plot.iterations.back()),
           ink(TextStyle::Anchor::End));
}

/// One paragraph for each family of values, with the panels that have it, and one paragraph for
/// numbers.
std::vector<FlowingLegend> legends_of(const SamplingPlot& plot, const CategoryColors& colors) {
  std::vector<std::vector<LegendEntry>> paragraphs;
  for (const auto& family : colors.families()) {
    auto& entries = paragraphs.emplace_back();
    for (const auto& panel : plot.panels) {
      if (!CategoryColors::belongs(panel.categories, family)) continue;
      if (!entries.empty()) entries.back().text += ",";
      entries.push_back({"", panel.name});
    }
    entries.back().text += ":";
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

/// The width of the numbers left of the panels.
double ends_room(const SamplingPlot& plot) {
  double widest = text_width("0", kTextSize);
  for (const auto& panel : plot.panels) {
    if (!panel.categories.empty()) continue;
    for (const std::string& text : end_texts(panel))
      widest = std::max(widest, text_width(text, kTextSize));
  }
  return widest + 1;
}

std::string description_of(const SamplingPlot& plot) {
  std::string names;
  for (const auto& panel : plot.panels)
    names += (names.empty() ? "" : ", ") + panel.name;
  return fmt::format("Values sampled by iteration, {}, a panel each of {}. {}",
                     counted(plot.iterations.size(), "iteration"), names, plot.caption);
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
      broken_text(plot.caption, kTextSize, width, kMostCaptionLines);
  const std::size_t across =
      std::clamp<std::size_t>(plot.panels_a_line, 1, std::max<std::size_t>(1, plot.panels.size()));
  const std::size_t full_lines = (plot.panels.size() + across - 1) / across;
  const auto lines = static_cast<double>(full_lines);
  const double room = ends_room(plot);
  const double pitch = (width + kBetween) / static_cast<double>(across);
  const double area_width = pitch - kBetween - room;
  const double area_height = std::min(kTallestPanel, kSampleRatio * (pitch - kBetween));
  double names = kLineHeight;
  for (const auto& panel : plot.panels) {
    const auto name_lines = whole_lines(panel.name, kTextSize, pitch - 1).size();
    names = std::max(names, 1 + kPanelNameLine * static_cast<double>(name_lines));
  }
  const double line_height = names + area_height + 0.6 + kLineHeight;
  const double head = head_of(plot);
  double legend_top = head + lines * line_height + kLineHeight + 1;
  const double caption_top = legend_top + legends_height + kTextSize;
  Svg svg(plot.width_mm,
          caption_top + kLineHeight * static_cast<double>(caption.size()) - kTextSize + kMargin,
          plot.title, description_of(plot));
  draw_heading(svg, plot.title, plot.details);
  for (std::size_t i = 0; i < plot.panels.size(); ++i) {
    const SamplingPlot::Panel& panel = plot.panels[i];
    const std::size_t line = i / across;
    const PlotArea area{.left = kMargin + room + pitch * static_cast<double>(i % across),
                        .top = head + names + line_height * static_cast<double>(line),
                        .width = area_width,
                        .height = area_height};
    SamplingPanel drawing(svg, panel, area);
    if (panel.categories.empty()) {
      drawing.densities();
    } else {
      drawing.shares(colors);
    }
    drawing.frame({area.left - room, area.top - 1}, pitch - 1);
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
