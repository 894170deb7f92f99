#include "tracking/scoring/internal/floor_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "tracking/geometry/walls.h"

namespace swarmsmith {
namespace {

using Channels = std::array<double, 3>;

constexpr double kGrid_m = 0.025;
/// The borders of patches are uncertain by this distance, due to errors of image, survey and
/// calibration.
constexpr double kBorder_m = 0.03;
/// Walls hide the floor behind them from the camera, and cast shadows.
constexpr double kWall_m = 0.08;
/// Radius around a robot's centre, including its tag's plate; and the height of the robot.
constexpr double kRobot_m = 0.155;
constexpr double kRobotHeight_m = 0.25;
/// Number of floor spots, the nearest ones, with which a patch is compared.
constexpr std::size_t kSpots = 60;
constexpr std::size_t kLeastSpots = 15;
/// Number of samples along each side of a place, and their distance from its border.
constexpr int kSamples = 15;
constexpr double kWithin_m = 0.02;
/// Smallest share of these samples that must be visible: robots that stop on a patch leave a corner
/// of it visible.
constexpr double kLeastShare = 0.05;
/// Range of grey levels in which colours can be measured.
constexpr double kDarkest = 6;
constexpr double kBrightest = 252;

bool is_near(const Rectangle& place, Point point) {
  return std::fabs(point.x - place.centre.x) <= 0.5 * place.width_m + kBorder_m &&
         std::fabs(point.y - place.centre.y) <= 0.5 * place.height_m + kBorder_m;
}

/// Whether there is only bare floor at a point and around it.
bool is_bare(const Mission& mission, Point point) {
  for (const Rectangle& place : mission.shuffled.places) {
    if (is_near(place, point)) return false;
  }
  const Arena& arena = mission.arena;
  for (const double dx : {-kBorder_m, 0.0, kBorder_m}) {
    for (const double dy : {-kBorder_m, 0.0, kBorder_m}) {
      if (floor_at(arena, {point.x + dx, point.y + dy}) != arena.floor) return false;
    }
  }
  return is_inside(arena, point) && distance_to_walls(arena, point) > kWall_m;
}

Channels median_color(std::vector<Channels> colors) {
  Channels medians{};
  const auto middle = colors.begin() + static_cast<std::ptrdiff_t>(colors.size() / 2);
  for (std::size_t channel = 0; channel < medians.size(); ++channel) {
    std::ranges::nth_element(colors, middle, {}, [&](const Channels& c) { return c.at(channel); });
    medians.at(channel) = middle->at(channel);
  }
  return medians;
}

}  // namespace

FloorLight::FloorLight(const FloorPicture& picture, const Mission& mission)
    : picture_(picture), mission_(mission), camera_(picture.view.place.centre()) {
  double reach = 0;
  for (const Wall& wall : mission.arena.walls)
    reach = std::max({reach, std::fabs(wall.from.x), std::fabs(wall.from.y)});
  const int steps = static_cast<int>(reach / kGrid_m);
  for (int column = -steps; column <= steps; ++column) {
    for (int row = -steps; row <= steps; ++row) {
      const Point at{column * kGrid_m, row * kGrid_m};
      if (!is_bare(mission, at) || is_hidden(at)) continue;
      if (const auto rgb = color_at(at)) floor_.push_back({at, *rgb});
    }
  }
}

std::optional<std::string> FloorLight::fault() const {
  const Rgb& floor = mission_.arena.floor;
  if (std::min({floor.r, floor.g, floor.b}) < 16) {
    return "the mission's floor is too dark to tell colours by";
  }
  if (floor_.size() < kLeastSpots) return "hardly any bare floor is to be seen in the pictures";
  std::vector<Channels> colors;
  for (const Spot& spot : floor_)
    colors.push_back(spot.rgb);
  const Channels light = median_color(std::move(colors));
  const auto [least, most] = std::ranges::minmax(light);
  if (least < kDarkest) {
    return fmt::format("the pictures are too dark: the floor has {:.0f} of 255", least);
  }
  if (most > kBrightest) {
    return fmt::format("the pictures are overexposed: the floor has {:.0f} of 255", most);
  }
  return std::nullopt;
}

std::optional<std::array<double, 3>> FloorLight::ratio_of(const Rectangle& place) const {
  std::vector<Channels> within;
  for (int column = 0; column < kSamples; ++column) {
    for (int row = 0; row < kSamples; ++row) {
      const double u = static_cast<double>(column) / (kSamples - 1) - 0.5;
      const double v = static_cast<double>(row) / (kSamples - 1) - 0.5;
      const Point at{place.centre.x + u * (place.width_m - 2 * kWithin_m),
                     place.centre.y + v * (place.height_m - 2 * kWithin_m)};
      if (is_hidden(at)) continue;
      if (const auto rgb = color_at(at)) within.push_back(*rgb);
    }
  }
  if (static_cast<double>(within.size()) < kLeastShare * kSamples * kSamples) return std::nullopt;
  std::vector<Spot> around = floor_;
  const auto apart = [&](const Spot& spot) {
    return hypot(spot.at.x - place.centre.x, spot.at.y - place.centre.y);
  };
  std::ranges::stable_sort(around, {}, apart);
  std::vector<Channels> floor;
  for (std::size_t i = 0; i < std::min(kSpots, around.size()); ++i)
    floor.push_back(around[i].rgb);
  const Channels inside = median_color(std::move(within));
  const Channels outside = median_color(std::move(floor));
  Channels ratio{};
  for (std::size_t i = 0; i < ratio.size(); ++i)
    ratio.at(i) = inside.at(i) / std::max(1.0, outside.at(i));
  return ratio;
}

/// Whether a point is under a robot or hidden behind it. A point at `height` above the floor hides
/// a floor point that is farther from the point below the camera, by the share height / (camera's
/// height - height).
bool FloorLight::is_hidden(Point point) const {
  const double share = kRobotHeight_m / (camera_.z - kRobotHeight_m);
  for (const Point& robot : picture_.robots) {
    const double dx = share * (robot.x - camera_.x);
    const double dy = share * (robot.y - camera_.y);
    const double squares = dx * dx + dy * dy;
    const double along = (point.x - robot.x) * dx + (point.y - robot.y) * dy;
    const double part = squares > 0 ? std::clamp(along / squares, 0.0, 1.0) : 0;
    if (hypot(point.x - robot.x - part * dx, point.y - robot.y - part * dy) <
        kRobot_m * (1 + part * share)) {
      return true;
    }
  }
  return false;
}

std::optional<std::array<double, 3>> FloorLight::color_at(Point point) const {
  const ImagePoint pixel = image_of(picture_.view, Point3{point.x, point.y, 0});
  const ColorImage& image = picture_.image;
  const double u = std::round(pixel.u);
  const double v = std::round(pixel.v);
  if (!(u >= 0 && v >= 0 && u < image.width && v < image.height)) return std::nullopt;
  const std::size_t at = 3 * (static_cast<std::size_t>(v) * static_cast<std::size_t>(image.width) +
                              static_cast<std::size_t>(u));
  return Channels{static_cast<double>(image.bgr[at + 2]), static_cast<double>(image.bgr[at + 1]),
                  static_cast<double>(image.bgr[at])};
}

}  // namespace swarmsmith
