#include "analysis/arena/internal/arena_drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "analysis/drawing/figure_style.h"
#include "base/math.h"
#include "base/overloaded.h"

namespace swarmsmith {
namespace {

constexpr std::size_t kCyclesASecond = 10;
constexpr double kTolerance = 0.06;        ///< of trails, mm: less than a pixel at 300 per inch
constexpr double kSmallestNumbered = 4.5;  ///< smallest body in which a number is drawn, mm
/// A trail is drawn in this number of parts, each slightly stronger than the one before.
constexpr std::size_t kFadeSteps = 8;

/// How far floor colours are lightened towards white.
constexpr double kFloorPaleness = 0.5;

std::string color_text(Rgb color) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text = "#";
  for (const unsigned channel : {color.r, color.g, color.b}) {
    text += kDigits[channel / 16];
    text += kDigits[channel % 16];
  }
  return text;
}

/// The drawn colour of a floor: black remains darker than grey, and trails are visible on both.
std::string floor_color(Rgb color) {
  return lightened(color_text(color), kFloorPaleness);
}

/// Black on light colours, white on dark ones.
std::string contrast_of(const std::string& color) {
  const auto channel = [&](std::size_t at) { return std::stoi(color.substr(at, 2), nullptr, 16); };
  const int gray = 299 * channel(1) + 587 * channel(3) + 114 * channel(5);
  return gray > 140'000 ? "#000000" : "#ffffff";
}

/// Draws a thin line that becomes stronger with time, on top of a white line if `on_white`.
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
    const auto points = simplified(track.subspan(first, last - first + 1), kTolerance);
    // A robot that does not move leaves no trail.
    if (points.size() == 2 && points.front() == points.back()) continue;
    svg.line(points, stroked(lightened(color, 0.6 * age), 0.4));
  }
}

/// How far the outline extends to the front.
double front_of(const Outline& outline) {
  double front = 0;
  for (const Point corner : corners_of(outline))
    front = std::max(front, corner.x);
  return front;
}

/// Draws only the outline, with a line towards its front.
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

/// Draws the body with a triangle at its front and its number, if there is room for the number.
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

/// Draws the end of the trail on top of its robot, and dots with the time.
void draw_times(Svg& svg, const ArenaView& view, const ArenaPicture& picture, std::size_t number) {
  const std::vector<PagePoint> track = view.track(picture.robots[number].poses);
  const std::string color = distinct_color(number);
  const auto apart = [](const PagePoint& a, const PagePoint& b) {
    return std::hypot(a.x - b.x, a.y - b.y);
  };
  const double body = view.length(front_of(picture.body));
  std::size_t first = track.size() - 1;
  while (first > 0 && apart(track[first], track.back()) <= body)
    --first;
  const auto tail = simplified(std::span(track).subspan(first), kTolerance);
  if (tail.size() > 1) svg.line(tail, stroked(contrast_of(color), 0.25));
  constexpr double kSecondsDot = 0.55;
  // A time must not cover a robot's number.
  const auto is_on_robot = [&](const PagePoint& place) {
    return std::ranges::any_of(picture.robots, [&](const PicturedRobot& robot) {
      return apart(place, view.on(robot.poses.back(), {0, 0})) < body + kSecondsDot;
    });
  };
  std::optional<PagePoint> before;
  const auto every = static_cast<std::size_t>(picture.cycles_a_mark);
  for (std::size_t cycle = every; cycle < track.size(); cycle += every) {
    const PagePoint& at = track[cycle];
    // A robot that does not move gets only one dot.
    if (before && apart(*before, at) < 4 * kSecondsDot) continue;
    before = at;
    if (is_on_robot(at)) continue;
    svg.circle(at, kSecondsDot, {.fill = "#ffffff", .stroke = color, .width = 0.3, .dashes = {}});
    const std::string text = std::to_string(cycle / kCyclesASecond);
    const double size = 0.75 * kTextSize;
    const double half = 0.3 * size * static_cast<double>(text.size());
    for (const double side : {1.0, -1.0}) {
      const PagePoint middle{at.x + side * (1.5 * kSecondsDot + half), at.y - kSecondsDot};
      if (is_on_robot({middle.x, middle.y - 0.36 * size})) continue;
      svg.text(middle, text,
               {.size = size,
                .anchor = TextStyle::Anchor::Middle,
                .bold = true,
                .fill = std::string(kInk)});
      break;
    }
  }
}

}  // namespace

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
                   },
                   [&](const FloorImage& image) {
                     const Rectangle& area = image.area;
                     svg.image(view.at({area.centre.x - area.width_m / 2,
                                        area.centre.y + area.height_m / 2}),
                               view.length(area.width_m), view.length(area.height_m),
                               image.picture->png(), 1 - kFloorPaleness);
                   }},
        patch.shape);
  }
  // Patches may extend beyond the walls, where there is no floor.
  svg.outside(walls, filled("#ffffff"));
  for (const Obstacle& obstacle : arena.obstacles)
    svg.polygon(view.outline(obstacle.outline, obstacle.pose), filled("#4d4d4d"));
  svg.polygon(walls, stroked(kInk, 0.6));
}

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
  // In large swarms, the white edges of trails would hide too much.
  const bool on_white = picture.robots.size() <= kMostNamedRobots;
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
  if (picture.cycles_a_mark <= 0 || !on_white) return;
  for (std::size_t i = 0; i < picture.robots.size(); ++i)
    draw_times(svg, view, picture, i);
}

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
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g m", length);
  svg.text({right + 1, y + 1}, text.data(), {.size = kTextSize, .fill = std::string(kInk)});
}

}  // namespace swarmsmith
