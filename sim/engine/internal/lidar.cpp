#include "sim/engine/internal/lidar.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/math.h"

namespace swarmsmith {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRaysPerRadian = kLidarRays / (2 * kPi);

/// A point in the scanning robot's frame, and which ray goes through it: a real number in
/// (-359.5, 359.5].
struct Corner {
  Point at;
  double ray = 0;
};

/// One scan under way.
class Scanner {
 public:
  Scanner(const Body& self, std::span<double> ranges_m) : self_(self), ranges_m_(ranges_m) {
    std::fill(ranges_m.begin(), ranges_m.end(), kInfinity);
  }

  /// A face that can be seen from its left only.
  void meet_wall(const Point& from, const Point& to) {
    meet_face(corner_at(from.x, from.y), corner_at(to.x, to.y));
  }

  void meet_solid(const Form& form, const Body& at) {
    if (form.is_circle()) return meet_circle(at, form.radius_m);
    const auto corner = [&](std::size_t i) {
      const Point local = form.corners[i];
      return corner_at(at.x + at.cos * local.x - at.sin * local.y,
                       at.y + at.sin * local.x + at.cos * local.y);
    };
    const Corner first = corner(0);
    Corner from = first;
    for (std::size_t i = 1; i <= form.corners.size(); ++i) {
      const Corner to = i < form.corners.size() ? corner(i) : first;
      meet_face(to, from);  // counter-clockwise corners: seen from outside, on the right
      from = to;
    }
  }

  /// Not met from inside, as with polygons.
  void meet_circle(const Body& at, double radius_m) {
    const Corner centre = corner_at(at.x, at.y);
    const double distance2 = centre.at.x * centre.at.x + centre.at.y * centre.at.y;
    const double tangent2 = distance2 - radius_m * radius_m;
    if (tangent2 <= 0) return;
    const double half = atan2(radius_m, std::sqrt(tangent2)) * kRaysPerRadian;
    for_rays(centre.ray - half, centre.ray + half, [&](const RayDirection& ray) {
      const double ahead = ray.x * centre.at.x + ray.y * centre.at.y;
      const double aside = ray.x * centre.at.y - ray.y * centre.at.x;
      return ahead - std::sqrt(std::max(0.0, radius_m * radius_m - aside * aside));
    });
  }

 private:
  Corner corner_at(double x, double y) const {
    const double dx = x - self_.x;
    const double dy = y - self_.y;
    const Point at = {self_.cos * dx + self_.sin * dy, self_.cos * dy - self_.sin * dx};
    return {at, atan2(at.y, at.x) * kRaysPerRadian};
  }

  /// The segment between two corners, when `to` lies counter-clockwise of `from`. Neighbouring
  /// faces share a corner's `ray`, so that no ray slips between them.
  void meet_face(const Corner& from, const Corner& to) {
    const Point edge = {to.at.x - from.at.x, to.at.y - from.at.y};
    const double area = from.at.x * edge.y - from.at.y * edge.x;
    if (area <= 0) return;
    const double sweep = to.ray - from.ray + (to.ray < from.ray ? kLidarRays : 0);
    if (sweep > kLidarRays / 2.0) return;  // seen end-on: rounding put the corners in wrong order
    // A ray along the face has no good quotient, but it ends at the farther corner at the latest.
    const double farthest = std::sqrt(std::max(from.at.x * from.at.x + from.at.y * from.at.y,
                                               to.at.x * to.at.x + to.at.y * to.at.y));
    for_rays(from.ray, from.ray + sweep, [&](const RayDirection& ray) {
      const double across = ray.x * edge.y - ray.y * edge.x;
      return across > 0 ? std::min(area / across, farthest) : farthest;
    });
  }

  /// Shortens the rays from one place to another, both included, to the distances given.
  template <class Distance>
  void for_rays(double from, double to, const Distance& distance_along) {
    const int last = static_cast<int>(std::floor(to));
    for (int i = static_cast<int>(std::ceil(from)); i <= last; ++i) {
      const auto ray = static_cast<std::size_t>(i < 0             ? i + kLidarRays
                                                : i >= kLidarRays ? i - kLidarRays
                                                                  : i);
      ranges_m_[ray] = std::min(ranges_m_[ray], distance_along(directions_[ray]));
    }
  }

  const Body& self_;
  std::span<double> ranges_m_;
  const std::array<RayDirection, kLidarRays>& directions_ = lidar_directions();
};

double limited_to_lidar(double distance_m) {
  if (distance_m < kLidarLeast_m) return -kInfinity;
  return distance_m > kLidarMost_m ? kInfinity : distance_m;
}

}  // namespace

void scan_surroundings(const World& world, int robot, std::span<double> ranges_m) {
  Scanner scanner(world.body(robot), ranges_m);
  const std::vector<WallPlane>& walls = world.walls().planes;
  for (std::size_t i = 0; i < walls.size(); ++i)  // each wall ends where the next one begins
    scanner.meet_wall(walls[i].from, walls[(i + 1) % walls.size()].from);
  for (const FixedSolid& obstacle : world.obstacles()) {
    if (obstacle.form.height_m >= kLidarHeight_m) scanner.meet_solid(obstacle.form, obstacle.at);
  }
  for (int mover = 0; mover < world.movers(); ++mover) {
    if (mover == robot || world.form(mover).height_m < kLidarHeight_m) continue;
    scanner.meet_solid(world.form(mover), world.body(mover));
  }
}

void scan_turrets(const World& world, int robot, std::span<double> ranges_m) {
  Scanner scanner(world.body(robot), ranges_m);
  for (int other = 0; other < world.robots(); ++other) {
    if (other != robot) scanner.meet_circle(world.body(other), kTurretRadius_m);
  }
}

void add_lidar_noise(std::span<double> ranges_m, double half_width_m, const NoiseStream& noise,
                     std::int64_t cycle) {
  std::uint64_t index = static_cast<std::uint64_t>(cycle) * kLidarRays;
  for (double& range : ranges_m) {
    range = limited_to_lidar(range);
    if (half_width_m > 0 && std::isfinite(range)) {
      range = limited_to_lidar(range + noise.at(index).uniform(-half_width_m, half_width_m));
    }
    ++index;
  }
}

}  // namespace swarmsmith
