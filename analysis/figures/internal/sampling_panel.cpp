#include "analysis/figures/internal/sampling_panel.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "analysis/drawing/figure_style.h"

namespace swarmsmith {
namespace {

constexpr std::string_view kFrame = "#999999";
constexpr std::string_view kDensityColor = "#2c5f8a";

std::size_t shade_of(double density) {
  std::size_t shade = 0;
  while (shade + 1 < kDensities.size() && density > kDensities[shade + 1])
    ++shade;
  return shade;
}

}  // namespace

std::string density_color(std::size_t shade) {
  constexpr std::array<double, kDensities.size()> kPaleness = {0.85, 0.6, 0.3, 0};
  return lightened(std::string(kDensityColor), kPaleness[shade]);
}

std::array<std::string, 2> end_texts(const SamplingPlot::Panel& panel) {
  // The range of whole numbers extends half a unit beyond the smallest and largest one.
  const double beyond = panel.is_whole ? 0.5 : 0;
  return {fmt::format("{:.4g}", panel.low + beyond), fmt::format("{:.4g}", panel.high - beyond)};
}

SamplingPanel::SamplingPanel(Svg& svg, const SamplingPlot::Panel& panel, const PlotArea& area)
    : svg_(svg), panel_(panel), area_(area), bands_(panel.columns.size(), area.left, area.right()) {
  // Narrow columns have no gaps, because gaps would hide most of their colour.
  thickness_ = bands_.width() < 1 ? bands_.width() : 0.9 * bands_.width();
}

void SamplingPanel::shares(const CategoryColors& colors) {
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

void SamplingPanel::densities() {
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
  const auto [low, high] = end_texts(panel_);
  ends(low, high);
}

void SamplingPanel::frame(PagePoint name, double width) {
  const std::array<PagePoint, 4> corners = {{{area_.left, area_.top},
                                             {area_.right(), area_.top},
                                             {area_.right(), area_.bottom()},
                                             {area_.left, area_.bottom()}}};
  svg_.polygon(corners, stroked(kFrame, 0.12));
  const auto lines = whole_lines(panel_.name, kTextSize, width);
  for (std::size_t i = 0; i < lines.size(); ++i)
    svg_.text({name.x, name.y - kPanelNameLine * static_cast<double>(lines.size() - 1 - i)},
              lines[i], ink(TextStyle::Anchor::Start));
}

void SamplingPanel::elites() {
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

void SamplingPanel::ends(const std::string& low, const std::string& high) {
  svg_.text({area_.left - 0.8, area_.bottom()}, low, ink(TextStyle::Anchor::End));
  svg_.text({area_.left - 0.8, area_.top + 0.72 * kTextSize}, high, ink(TextStyle::Anchor::End));
}

}  // namespace swarmsmith
