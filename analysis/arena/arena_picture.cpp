#include "analysis/arena/arena_picture.h"

#include <map>

#include "analysis/arena/internal/arena_drawing.h"
#include "analysis/arena/internal/arena_view.h"
#include "analysis/drawing/figure_style.h"
#include "analysis/drawing/legend.h"
#include "analysis/drawing/svg.h"

namespace swarmsmith {
namespace {

constexpr double kTallest = 1.25;  ///< maximum height of the arena, relative to the width
constexpr std::string_view kDot = " \xc2\xb7 ";

/// The parts on lines of at most this width, joined by dots.
std::vector<std::string> wrapped(const std::vector<std::string>& parts, double size, double width) {
  std::vector<std::string> lines;
  for (const std::string& part : parts) {
    if (part.empty()) continue;
    const std::string longer = lines.empty() ? part : lines.back() + std::string(kDot) + part;
    if (!lines.empty() && text_width(longer, size) <= width) {
      lines.back() = longer;
    } else {
      lines.push_back(fitted_text(part, size, width));
    }
  }
  return lines;
}

/// The final activity of each robot; for a large swarm, the number of robots per activity.
std::vector<LegendEntry> legend_of(const ArenaPicture& picture) {
  std::vector<LegendEntry> entries;
  if (picture.robots.size() <= kMostNamedRobots) {
    for (std::size_t i = 0; i < picture.robots.size(); ++i) {
      const std::string& label = picture.robots[i].label;
      entries.push_back(
          {distinct_color(i), std::to_string(i) + (label.empty() ? "" : " " + label)});
    }
    return entries;
  }
  std::map<std::string, int> counts;
  for (const PicturedRobot& robot : picture.robots)
    ++counts[robot.label];
  for (const auto& [label, count] : counts) {
    if (label.empty()) continue;
    entries.push_back({"", std::to_string(count) + " \xc3\x97 " + label});
  }
  return entries;
}

}  // namespace

Svg drawing_of(const ArenaPicture& picture) {
  const double width = picture.width_mm - 2 * kMargin;
  const auto lines = wrapped(picture.details, kTextSize, width);
  const double top = kMargin + kLineHeight * static_cast<double>(lines.size() + 1) + 0.6;
  const ArenaView view(picture.arena, kMargin, top, width, kTallest * width);
  const Legend legend(legend_of(picture), width);
  const double scale_top = view.bottom() + 1.2;
  const double legend_top = scale_top + kLineHeight;
  std::string description;
  for (const std::string& detail : picture.details)
    description += (description.empty() ? "" : ", ") + detail;

  Svg svg(picture.width_mm, legend_top + legend.height() + kMargin, picture.title, description);
  draw_place(svg, picture, view);
  draw_objects(svg, picture, view);
  draw_robots(svg, picture, view);
  for (const Light& light : picture.arena.lights)
    draw_light(svg, view.at({light.x_m, light.y_m}));
  double y = kMargin + 2.8;
  svg.text({kMargin, y}, fitted_text(picture.title, kBolder * kTitleSize, width),
           {.size = kTitleSize, .bold = true, .fill = std::string(kInk)});
  for (const std::string& line : lines) {
    y += kLineHeight;
    svg.text({kMargin, y}, line, {.size = kTextSize, .fill = std::string(kInk)});
  }
  draw_scale(svg, view, scale_top);
  legend.draw(svg, legend_top);
  return svg;
}

std::string draw(const ArenaPicture& picture) {
  return drawing_of(picture).finish();
}

}  // namespace swarmsmith
