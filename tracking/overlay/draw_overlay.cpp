#include "tracking/overlay/draw_overlay.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <variant>

#include "tracking/overlay/internal/brush.h"

namespace swarmsmith {
namespace {

// The colours of Okabe and Ito, which people can distinguish with any colour vision.
constexpr std::array<Rgb, 6> kRobotColors = {
    {{230, 159, 0}, {86, 180, 233}, {240, 228, 66}, {204, 121, 167}, {0, 158, 115}, {213, 94, 0}}};
constexpr Rgb kWhite{255, 255, 255};
constexpr Rgb kGrey{200, 200, 200};
constexpr Rgb kWarning{255, 190, 90};
constexpr Rgb kTile{86, 180, 233};
constexpr double kTileShare = 0.55;
/// Time in which a tile fades to a third.
constexpr double kTileFades_s = 15;
/// Smaller tiles have no room for their ages.
constexpr double kLeastTileWithAge_px = 55;
constexpr std::size_t kMostWarnings = 4;

std::vector<Point> outline_of(const Outline& outline) {
  constexpr int kCircleCorners = 36;
  if (const auto* const box = std::get_if<BoxOutline>(&outline)) {
    const double x = box->length_m / 2;
    const double y = box->width_m / 2;
    return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
  }
  if (const auto* const polygon = std::get_if<PolygonOutline>(&outline)) return polygon->corners;
  std::vector<Point> corners;
  const double radius_m = std::get<CircleOutline>(outline).radius_m;
  for (int i = 0; i < kCircleCorners; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCircleCorners;
    corners.push_back({radius_m * std::cos(angle), radius_m * std::sin(angle)});
  }
  return corners;
}

std::vector<Point> outline_of(const Rectangle& area) {
  const double x = area.width_m / 2;
  const double y = area.height_m / 2;
  return {{area.centre.x - x, area.centre.y - y},
          {area.centre.x + x, area.centre.y - y},
          {area.centre.x + x, area.centre.y + y},
          {area.centre.x - x, area.centre.y + y}};
}

std::vector<Point> outline_of(const Patch& patch) {
  if (const auto* const rectangle = std::get_if<Rectangle>(&patch.shape))
    return outline_of(*rectangle);
  if (const auto* const image = std::get_if<FloorImage>(&patch.shape))
    return outline_of(image->area);
  const Disc& disc = std::get<Disc>(patch.shape);
  std::vector<Point> corners = outline_of(Outline(CircleOutline{disc.radius_m}));
  for (Point& corner : corners) {
    corner.x += disc.centre.x;
    corner.y += disc.centre.y;
  }
  return corners;
}

std::vector<Point3> at_height(const std::vector<Point>& points, double height_m) {
  std::vector<Point3> result;
  result.reserve(points.size());
  for (const Point& point : points)
    result.push_back({point.x, point.y, height_m});
  return result;
}

/// A point of a body with this pose, at this height in the world.
Point3 placed(const Pose& pose, double height_m, Point own) {
  const double c = std::cos(pose.theta);
  const double s = std::sin(pose.theta);
  return {pose.x + c * own.x - s * own.y, pose.y + s * own.x + c * own.y, height_m};
}

Point3 on_robot(const OverlayRobot& robot, Point own) {
  return placed(robot.pose, robot.height_m, own);
}

cv::Point2d seen_at(const View& view, const Point3& world) {
  const ImagePoint at = image_of(view, world);
  return {at.u, at.v};
}

/// The colour of a patch's line: the patch's colour, but white for dark patches, on which their own
/// colour would be invisible.
Rgb line_color_of(const Patch& patch) {
  const bool is_dark = std::max({patch.color.r, patch.color.g, patch.color.b}) < 100;
  return is_dark || std::holds_alternative<FloorImage>(patch.shape) ? kWhite : patch.color;
}

void draw_tiles(Brush& brush, const View& view, const Coverage& rule,
                const std::vector<double>& ages_s) {
  const double side_m = rule.side_m / rule.tiles;
  std::vector<std::vector<cv::Point2d>> shapes;
  std::vector<double> shares;
  for (std::size_t i = 0; i < ages_s.size(); ++i) {
    const auto tiles = static_cast<std::size_t>(rule.tiles);
    const std::size_t row = i / tiles;
    const double x = -rule.side_m / 2 + side_m * (static_cast<double>(i % tiles) + 0.5);
    const double y = -rule.side_m / 2 + side_m * (static_cast<double>(row) + 0.5);
    shapes.push_back(
        Brush::seen(view, at_height(outline_of(Rectangle{{x, y}, side_m, side_m}), 0), true));
    shares.push_back(kTileShare * std::exp(-ages_s[i] / kTileFades_s));
  }
  brush.fill(shapes, kTile, shares);
  // Tiles without a visit all have the largest age, which is not written on them.
  const double oldest_s = *std::max_element(ages_s.begin(), ages_s.end());
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (shapes[i].size() < 4) continue;
    brush.hairline(shapes[i], kGrey);
    cv::Point2d middle;
    for (const cv::Point2d& corner : shapes[i])
      middle += corner;
    middle /= static_cast<double>(shapes[i].size());
    const cv::Point2d edge = shapes[i][shapes[i].size() / 4] - shapes[i][0];
    if (ages_s[i] < oldest_s && std::hypot(edge.x, edge.y) >= kLeastTileWithAge_px)
      brush.note(middle, fmt::format("{:.0f} s", ages_s[i]), kWhite);
  }
}

/// The lines of text for a moment of a run.
std::vector<std::string> lines_of(const Mission& mission, const OverlayMoment& moment) {
  const double duration_s = mission.cycles * kControlPeriod_s;
  std::string time;
  if (moment.time_s < 0)
    time = fmt::format("begins in {:.1f} s", -moment.time_s);
  else if (moment.time_s > duration_s + 1e-6)
    time = fmt::format("ended after {:.1f} s", duration_s);
  else
    time = fmt::format("{:.1f} of {:.1f} s", moment.time_s, duration_s);
  std::vector<std::string> lines{mission.name, time};
  if (moment.score.has_value()) lines.push_back(fmt::format("score {:.6g}", *moment.score));
  return lines;
}

}  // namespace

void draw_floor(ColorImage& image, const View& view, const Mission& mission,
                const std::vector<double>& tile_ages_s) {
  Brush brush(image);
  if (const auto* const coverage = std::get_if<Coverage>(&mission.rule);
      coverage != nullptr && !tile_ages_s.empty())
    draw_tiles(brush, view, *coverage, tile_ages_s);
  for (const Patch& patch : mission.arena.patches)
    brush.line(Brush::seen(view, at_height(outline_of(patch), 0), true), line_color_of(patch), 2,
               true);
  std::vector<Point> corners;
  for (const Wall& wall : mission.arena.walls)
    corners.push_back(wall.from);
  brush.line(Brush::seen(view, at_height(corners, 0), true), kWhite, 1.5, true);
  for (const Obstacle& obstacle : mission.arena.obstacles) {
    std::vector<Point3> around;
    for (const Point& corner : outline_of(obstacle.outline))
      around.push_back(placed(obstacle.pose, 0, corner));
    brush.line(Brush::seen(view, around, true), kWhite, 1.5, true);
  }
}

void draw_robots(ColorImage& image, const View& view, const Outline& body,
                 const std::vector<OverlayRobot>& robots) {
  Brush brush(image);
  for (std::size_t i = 0; i < robots.size(); ++i)
    brush.line(Brush::seen(view, at_height(robots[i].trail, 0), false),
               kRobotColors[i % kRobotColors.size()], 2, false);
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const OverlayRobot& robot = robots[i];
    const Rgb color = kRobotColors[i % kRobotColors.size()];
    std::vector<Point3> around;
    double reach_m = 0;
    for (const Point& corner : outline_of(body)) {
      around.push_back(on_robot(robot, corner));
      reach_m = std::max(reach_m, corner.x);
    }
    const std::vector<cv::Point2d> shape = Brush::seen(view, around, true);
    if (robot.kind == CycleKind::Measured) brush.fill({shape}, color, std::array{0.35});
    brush.line(shape, color, robot.kind == CycleKind::Measured ? 2 : 1, true);
    // This line leaves the body at its front.
    brush.line({seen_at(view, on_robot(robot, {0, 0})),
                seen_at(view, on_robot(robot, {1.3 * reach_m, 0}))},
               color, 3, false);
    const cv::Point2d foot = seen_at(view, {robot.pose.x, robot.pose.y, 0});
    brush.line({seen_at(view, on_robot(robot, {0, 0})), foot}, color, 1, false);
    brush.cross(foot, kWhite, 7, 2);
  }
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const OverlayRobot& robot = robots[i];
    const cv::Point2d at = seen_at(view, {robot.pose.x, robot.pose.y, robot.height_m});
    std::string text = robot.name;
    if (robot.kind == CycleKind::Interpolated || robot.kind == CycleKind::Degraded) text += " gap";
    if (robot.kind == CycleKind::Missing) text += " lost";
    brush.label({at.x + 52 * brush.scale(), at.y - 34 * brush.scale()}, text,
                kRobotColors[i % kRobotColors.size()]);
  }
}

void draw_tags(ColorImage& image, const std::vector<OverlayTag>& tags) {
  Brush brush(image);
  for (const OverlayTag& each : tags) {
    const Rgb color = each.kind == OverlayTag::Kind::Unknown ? kWarning : kWhite;
    std::vector<cv::Point2d> corners;
    cv::Point2d lowest(0, -1e9);
    for (const ImagePoint& corner : each.corners) {
      corners.emplace_back(corner.u, corner.v);
      if (corner.v > lowest.y) lowest = corners.back();
    }
    brush.line(corners, color, 1.5, true);
    // Marks the lower edge of the upright tag, so that a wrong rotation is visible.
    brush.line({corners[0], corners[1]}, color, 4, false);
    brush.label({lowest.x, lowest.y + 28 * brush.scale()},
                fmt::format("{}{}", each.tag, each.kind == OverlayTag::Kind::Unknown ? "?" : ""),
                color);
  }
}

void draw_words(ColorImage& image, const OverlayWords& words) {
  Brush brush(image);
  brush.panel(words.lines, kWhite, true);
  std::vector<std::string> warnings = words.warnings;
  if (warnings.size() > kMostWarnings) {
    const std::size_t more = warnings.size() - kMostWarnings + 1;
    warnings.resize(kMostWarnings - 1);
    warnings.push_back(fmt::format("and {} more", more));
  }
  brush.panel(warnings, kWarning, false);
}

void draw_overlay(ColorImage& image, const View& view, const Mission& mission,
                  const OverlayMoment& moment, const std::vector<OverlayTag>& tags) {
  draw_floor(image, view, mission, moment.tile_ages_s);
  draw_robots(image, view, mission.robot.body.outline, moment.robots);
  draw_tags(image, tags);
  draw_words(image, {lines_of(mission, moment), moment.issues});
}

}  // namespace swarmsmith
