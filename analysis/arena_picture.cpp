#include "analysis/arena_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <span>

#include "analysis/internal/arena_view.h"
#include "analysis/svg.h"
#include "base/math.h"
#include "base/overloaded.h"

namespace swarmsmith {
namespace {

// Lengths on the page, mm.
constexpr double kMargin = 2;
constexpr double kTitleSize = 3.4;
constexpr double kTextSize = 2.8;
constexpr double kBolder = 1.15;  ///< bold letters are so much wider
constexpr double kLineHeight = 4.2;
constexpr double kTallest = 1.25;          ///< of the arena, as part of the width
constexpr double kTolerance = 0.06;        ///< of trails: less than a pixel of 300 a inch
constexpr double kSmallestNumbered = 4.5;  ///< body with a number in it
/// Parts of a trail, each a little stronger than the one before.
constexpr std::size_t kFadeSteps = 8;
/// Swarms up to this size get a line each in the legend; larger ones a count of what they do.
constexpr std::size_t kMostLegendLines = 8;

constexpr std::string_view kInk = "#222222";
constexpr std::string_view kDot = " \xc2\xb7 ";

std::string color_text(Rgb color) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text = "#";
  for (const unsigned channel : {color.r, color.g, color.b}) {
    text += kDigits[channel / 16];
    text += kDigits[channel % 16];
  }
  return text;
}

/// What a floor colour looks like: black stays darker than grey, and trails are seen on both.
std::string floor_color(Rgb color) {
  return lightened(color_text(color), 0.5);
}

Paint filled(std::string_view fill) {
  return {.fill = std::string(fill), .stroke = "none", .width = 0, .dashes = {}};
}

Paint stroked(std::string_view stroke, double width) {
  return {.fill = "none", .stroke = std::string(stroke), .width = width, .dashes = {}};
}

/// Black on light colours, white on dark ones.
std::string contrast_of(const std::string& color) {
  const auto channel = [&](std::size_t at) { return std::stoi(color.substr(at, 2), nullptr, 16); };
  const int gray = 299 * channel(1) + 587 * channel(3) + 114 * channel(5);
  return gray > 140'000 ? "#000000" : "#ffffff";
}

/// Parts in lines of at most that width, joined by dots.
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

/// One entry below the arena.
struct LegendEntry {
  std::string color;  ///< of its swatch; empty for none
  std::string text;
};

std::vector<LegendEntry> legend_of(const ArenaPicture& picture) {
  std::vector<LegendEntry> entries;
  if (picture.robots.size() <= kMostLegendLines) {
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

/// Entries in equal columns, as many as fit.
struct LegendGrid {
  std::vector<LegendEntry> entries;
  double column_width = 0;
  std::size_t columns = 1;

  LegendGrid(std::vector<LegendEntry> all, double width) : entries(std::move(all)) {
    constexpr double kSwatchSpace = 4;
    double widest = 1;
    for (LegendEntry& entry : entries) {
      entry.text = fitted_text(entry.text, kTextSize, width - kSwatchSpace);
      widest = std::max(widest, text_width(entry.text, kTextSize));
    }
    columns = std::max<std::size_t>(1, static_cast<std::size_t>(width / (widest + kSwatchSpace)));
    columns = std::min(columns, std::max<std::size_t>(1, entries.size()));
    column_width = width / static_cast<double>(columns);
  }

  double height() const {
    return kLineHeight * static_cast<double>((entries.size() + columns - 1) / columns);
  }

  void draw(Svg& svg, double top) const {
    constexpr double kSwatch = 2.4;
    for (std::size_t i = 0; i < entries.size(); ++i) {
      const double x = kMargin + column_width * static_cast<double>(i % columns);
      const double y = top + kLineHeight * static_cast<double>(i / columns);
      double indent = 0;
      if (!entries[i].color.empty()) {
        const std::array<PagePoint, 4> box = {
            {{x, y}, {x + kSwatch, y}, {x + kSwatch, y + kSwatch}, {x, y + kSwatch}}};
        svg.polygon(box, filled(entries[i].color));
        indent = kSwatch + 0.8;
      }
      svg.text({x + indent, y + 2.2}, entries[i].text,
               {.size = kTextSize, .fill = std::string(kInk)});
    }
  }
};

/// Floor, patches, walls, and what stands there.
void draw_place(Svg& svg, const ArenaPicture& picture, const ArenaView& view) {
  const Arena& arena = picture.arena;
  const std::vector<PagePoint> walls = view.walls(arena);
  svg.polygon(walls, filled(floor_color(arena.floor)));
  for (const Patch& patch : arena.patches) {
    const Paint paint = filled(floor_color(patch.color));
    std::visit(
        Overloaded{[&](const Disc& disc) {
                     svg.circle(view.at(disc.centre), view.length(disc.radius_m), paint);
                   },
                   [&](const Rectangle& box) {
                     const Outline outline = BoxOutline{box.width_m, box.height_m};
                     svg.polygon(view.outline(outline, {box.centre.x, box.centre.y, 0}), paint);
                   }},
        patch.shape);
  }
  // Patches may reach beyond the walls, where there is no floor.
  svg.outside(walls, filled("#ffffff"));
  for (const Obstacle& obstacle : arena.obstacles)
    svg.polygon(view.outline(obstacle.outline, obstacle.pose), filled("#4d4d4d"));
  svg.polygon(walls, stroked(kInk, 0.6));
}

/// A small sun.
void draw_light(Svg& svg, PagePoint centre) {
  constexpr double kRadius = 1;
  for (int ray = 0; ray < 8; ++ray) {
    const SinCos turn = sin_cos(kPi / 4 * ray);
    const std::array<PagePoint, 2> line = {
        {{centre.x + 1.4 * kRadius * turn.cos, centre.y + 1.4 * kRadius * turn.sin},
         {centre.x + 2.1 * kRadius * turn.cos, centre.y + 2.1 * kRadius * turn.sin}}};
    svg.line(line, stroked(kInk, 0.25));
  }
  svg.circle(centre, kRadius,
             {.fill = "#f0e442", .stroke = std::string(kInk), .width = 0.25, .dashes = {}});
}

/// A thin line that grows stronger with time, on a white one if it shall stand out.
void draw_trail(Svg& svg, std::span<const PagePoint> track, const std::string& color,
                bool on_white) {
  if (track.size() < 2) return;
  if (on_white) svg.line(simplified(track, kTolerance), stroked("#ffffff", 0.7));
  const std::size_t steps = track.size() - 1;
  for (std::size_t part = 0; part < kFadeSteps; ++part) {
    const std::size_t first = steps * part / kFadeSteps;
    const std::size_t last = steps * (part + 1) / kFadeSteps;
    if (first == last) continue;
    const double age = 1 - static_cast<double>(part + 1) / static_cast<double>(kFadeSteps);
    svg.line(simplified(track.subspan(first, last - first + 1), kTolerance),
             stroked(lightened(color, 0.6 * age), 0.4));
  }
}

/// How far the outline goes to the front.
double front_of(const Outline& outline) {
  double front = 0;
  for (const Point corner : corners_of(outline))
    front = std::max(front, corner.x);
  return front;
}

/// Only the outline, with a line towards its head.
void draw_start(Svg& svg, const ArenaView& view, const Outline& body, const Pose& pose,
                const std::string& color) {
  const double front = front_of(body);
  const std::array<PagePoint, 2> head = {
      {view.on(pose, {0.5 * front, 0}), view.on(pose, {front, 0})}};
  for (const auto& [stroke, width] : {std::pair<std::string, double>("#ffffff", 0.7),
                                      std::pair<std::string, double>(color, 0.35)}) {
    svg.polygon(view.outline(body, pose), stroked(stroke, width));
    svg.line(head, stroked(stroke, width));
  }
}

/// The body with a triangle at its head and its number, where there is room for one.
void draw_robot(Svg& svg, const ArenaView& view, const Outline& body, const Pose& pose,
                std::size_t number) {
  const std::string color = distinct_color(number);
  const std::string mark = contrast_of(color);
  Paint paint = filled(color);
  paint.stroke = "#ffffff";
  paint.width = 0.25;
  svg.polygon(view.outline(body, pose), paint);
  const double front = front_of(body);
  const std::array<PagePoint, 3> head = {{view.on(pose, {0.9 * front, 0}),
                                          view.on(pose, {0.4 * front, 0.4 * front}),
                                          view.on(pose, {0.4 * front, -0.4 * front})}};
  svg.polygon(head, filled(mark));
  if (view.length(2 * front) < kSmallestNumbered) return;
  const double size = std::min(kTextSize, 0.4 * view.length(2 * front));
  const PagePoint centre = view.on(pose, {-0.25 * front, 0});
  svg.text({centre.x, centre.y + 0.36 * size}, std::to_string(number),
           {.size = size, .anchor = TextStyle::Anchor::Middle, .bold = true, .fill = mark});
}

void draw_objects(Svg& svg, const ArenaPicture& picture, const ArenaView& view) {
  constexpr std::string_view kEdge = "#6b4f1d";
  for (std::size_t i = 0; i < picture.objects.size(); ++i) {
    const std::vector<Pose>& poses = picture.objects[i];
    const Outline& outline = picture.arena.objects[i].outline;
    if (poses.front() != poses.back()) {
      Paint start = stroked(kEdge, 0.3);
      start.dashes = "0.9 0.7";
      svg.polygon(view.outline(outline, poses.front()), start);
      draw_trail(svg, view.track(poses), std::string(kEdge), false);
    }
    Paint paint = filled("#d9b778");
    paint.stroke = kEdge;
    paint.width = 0.3;
    svg.polygon(view.outline(outline, poses.back()), paint);
  }
}

void draw_robots(Svg& svg, const ArenaPicture& picture, const ArenaView& view) {
  // In large swarms the trails' white edges would hide more than they show.
  const bool on_white = picture.robots.size() <= kMostLegendLines;
  for (std::size_t i = 0; i < picture.robots.size(); ++i) {
    const PicturedRobot& robot = picture.robots[i];
    draw_trail(svg, view.track(robot.poses), distinct_color(i), on_white);
  }
  for (std::size_t i = 0; i < picture.robots.size(); ++i) {
    const PicturedRobot& robot = picture.robots[i];
    if (robot.poses.size() < 2) continue;
    draw_start(svg, view, picture.body, robot.poses.front(), distinct_color(i));
  }
  for (std::size_t i = 0; i < picture.robots.size(); ++i)
    draw_robot(svg, view, picture.body, picture.robots[i].poses.back(), i);
}

/// A bar of 1, 2 or 5 times a power of ten metres, at most a quarter of the picture.
void draw_scale(Svg& svg, const ArenaView& view, double top) {
  const double wanted = 0.25 * (svg.width() - 2 * kMargin) / view.scale();
  double length = 1;
  while (length > wanted)
    length /= 10;
  while (length * 10 <= wanted)
    length *= 10;
  for (const double factor : {5.0, 2.0}) {
    if (length * factor > wanted) continue;
    length *= factor;
    break;
  }
  const double right = kMargin + view.length(length);
  const double y = top + 1.2;
  const std::array<PagePoint, 4> bar = {
      {{kMargin, y - 0.6}, {kMargin, y + 0.6}, {right, y + 0.6}, {right, y - 0.6}}};
  svg.line(bar, stroked(kInk, 0.3));
  char text[32];
  std::snprintf(text, sizeof text, "%g m", length);
  svg.text({right + 1, y + 1}, text, {.size = kTextSize, .fill = std::string(kInk)});
}

}  // namespace

std::string draw(const ArenaPicture& picture) {
  const double width = picture.width_mm - 2 * kMargin;
  const auto lines = wrapped(picture.details, kTextSize, width);
  const double top = kMargin + kLineHeight * static_cast<double>(lines.size() + 1) + 0.6;
  const ArenaView view(picture.arena, kMargin, top, width, kTallest * width);
  const LegendGrid legend(legend_of(picture), width);
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
  return svg.finish();
}

}  // namespace swarmsmith
