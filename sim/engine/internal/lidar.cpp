#include "sim/engine/internal/lidar.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "base/math.h"

namespace swarmsmith {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRaysPerRadian = kLidarRays / (2 * kPi);

/// Which ray goes through a point in the scanning robot's frame: a real number in (-359.5, 359.5].
double ray_through(const Point& at) {
  return atan2(at.y, at.x) * kRaysPerRadian;
}

/// Quick rays are wrong by less than half of this.
constexpr double kQuickError = 3e-3;

/// The same within `kQuickError`, without waiting for a long polynomial: the arc tangent of [0, 1]
/// within 1e-5 (Abramowitz and Stegun, "Handbook of mathematical functions", 4.4.47).
double quick_ray_through(const Point& at) {
  const double ax = std::fabs(at.x);
  const double ay = std::fabs(at.y);
  const double u = std::min(ax, ay) / std::max({ax, ay, std::numeric_limits<double>::min()});
  const double s = u * u;
  const double arc =
      u * (0.9998660 + s * (-0.3302995 + s * (0.1801410 + s * (-0.0851330 + s * 0.0208351))));
  double angle = ay <= ax ? arc : kPi / 2 - arc;
  if (at.x < 0) angle = kPi - angle;
  return std::copysign(angle, at.y) * kRaysPerRadian;
}

/// Rays from one place counter-clockwise to another, which may be beyond the last ray.
struct Sweep {
  double from;
  double width;
};

Sweep sweep_between(double from, double to) {
  return {from, to - from + (to < from ? kLidarRays : 0)};
}

int floor_of(double x) {
  const int whole = static_cast<int>(x);
  return whole > x ? whole - 1 : whole;
}

int ceil_of(double x) {
  const int whole = static_cast<int>(x);
  return whole < x ? whole + 1 : whole;
}

bool is_about_whole(double ray) {
  return std::fabs(ray - floor_of(ray + 0.5)) < kQuickError;
}

/// A point in the scanning robot's frame.
struct Corner {
  Point at;
  double quick_ray = 0;
};

/// The rays between two points. Only which whole numbers lie between matters, so that the quick way
/// does wherever no such number, and no other border, is too close to tell.
Sweep sweep_between(const Corner& from, const Corner& to) {
  const Sweep quick = sweep_between(from.quick_ray, to.quick_ray);
  const bool sure = !is_about_whole(quick.from) && !is_about_whole(quick.from + quick.width) &&
                    quick.width > 2 * kQuickError &&
                    quick.width < kLidarRays / 2.0 - 2 * kQuickError;
  return sure ? quick : sweep_between(ray_through(from.at), ray_through(to.at));
}

/// The rays' directions, coordinate by coordinate, so that several rays are met at once.
struct Directions {
  std::array<double, kLidarRays> x;
  std::array<double, kLidarRays> y;
};

const Directions& directions_by_coordinate() {
  static const Directions directions = [] {
    Directions made;
    for (std::size_t ray = 0; ray < kLidarRays; ++ray) {
      made.x[ray] = lidar_directions()[ray].x;
      made.y[ray] = lidar_directions()[ray].y;
    }
    return made;
  }();
  return directions;
}

/// One scan under way.
class Scanner {
 public:
  Scanner(const Body& self, std::span<double> ranges_m) : self_(self), ranges_m_(ranges_m) {
    std::fill(ranges_m.begin(), ranges_m.end(), kInfinity);
  }

  /// Faces that can be seen from their left only, each from a corner to the next of its index.
  void meet_walls(const std::vector<WallPlane>& walls) {
    corners_.clear();
    for (const WallPlane& wall : walls)
      corners_.push_back(seen_at(wall.from.x, wall.from.y));
    for (std::size_t i = 0; i < corners_.size(); ++i)
      meet_face(corners_[i], corners_[(i + 1) % corners_.size()]);
  }

  void meet_solid(const Form& form, const Body& at) {
    if (form.is_circle()) return meet_circle(at, form.radius_m);
    corners_.clear();
    for (const Point& local : form.corners) {
      corners_.push_back(seen_at(at.x + at.cos * local.x - at.sin * local.y,
                                 at.y + at.sin * local.x + at.cos * local.y));
    }
    // Counter-clockwise corners: seen from outside, on the right.
    for (std::size_t i = 0; i < corners_.size(); ++i)
      meet_face(corners_[(i + 1) % corners_.size()], corners_[i]);
  }

  /// Not met from inside, as with polygons.
  void meet_circle(const Body& at, double radius_m) {
    const Point centre = seen_at(at.x, at.y).at;
    const double distance2 = centre.x * centre.x + centre.y * centre.y;
    const double tangent2 = distance2 - radius_m * radius_m;
    if (tangent2 <= 0) return;
    const double half = atan2(radius_m, std::sqrt(tangent2)) * kRaysPerRadian;
    const double ray = ray_through(centre);
    for_rays(ray - half, ray + half, [&](double ray_x, double ray_y) {
      const double ahead = ray_x * centre.x + ray_y * centre.y;
      const double aside = ray_x * centre.y - ray_y * centre.x;
      return ahead - std::sqrt(std::max(0.0, radius_m * radius_m - aside * aside));
    });
  }

 private:
  /// A point in the robot's own frame.
  Corner seen_at(double x, double y) const {
    const double dx = x - self_.x;
    const double dy = y - self_.y;
    const Point at = {self_.cos * dx + self_.sin * dy, self_.cos * dy - self_.sin * dx};
    return {at, quick_ray_through(at)};
  }

  /// The segment between two corners, when `to` lies counter-clockwise of `from`. Neighbouring
  /// faces end at the same place between two rays, so that no ray slips between them.
  void meet_face(const Corner& first, const Corner& second) {
    const Point& from = first.at;
    const Point& to = second.at;
    const Point edge = {to.x - from.x, to.y - from.y};
    const double area = from.x * edge.y - from.y * edge.x;
    if (area <= 0) return;
    const Sweep sweep = sweep_between(first, second);
    // Seen end-on: rounding put the corners in wrong order.
    if (sweep.width > kLidarRays / 2.0) return;
    // A ray along the face has no good quotient, but it ends at the farther corner at the latest.
    const double farthest =
        std::sqrt(std::max(from.x * from.x + from.y * from.y, to.x * to.x + to.y * to.y));
    for_rays(sweep.from, sweep.from + sweep.width, [&](double ray_x, double ray_y) {
      const double across = ray_x * edge.y - ray_y * edge.x;
      const double distance = area / across;
      const double nearer = farthest < distance ? farthest : distance;
      return across > 0 ? nearer : farthest;
    });
  }

  /// Shortens the rays from one place to another, both included, to the distances given.
  template <class Distance>
  void for_rays(double from, double to, const Distance& distance_along) {
    const int first = ceil_of(from);
    const int last = floor_of(to);
    double* const ranges = ranges_m_.data();
    const double* const x = directions_.x.data();
    const double* const y = directions_.y.data();
    // Places count from -719 to twice 719, and stand for rays from 0 to 718.
    for (const int around : {kLidarRays, 0, -kLidarRays}) {
      const int end = std::min(last + around, kLidarRays - 1);
      for (int i = std::max(first + around, 0); i <= end; ++i) {
        const double distance = distance_along(x[i], y[i]);
        ranges[i] = distance < ranges[i] ? distance : ranges[i];
      }
    }
  }

  const Body& self_;
  std::span<double> ranges_m_;
  const Directions& directions_ = directions_by_coordinate();
  std::vector<Corner> corners_;  ///< of what is met now
};

double limited_to_lidar(double distance_m) {
  const double seen = distance_m > kLidarMost_m ? kInfinity : distance_m;
  return distance_m < kLidarLeast_m ? -kInfinity : seen;
}

}  // namespace

void scan_surroundings(const World& world, int robot, std::span<double> ranges_m) {
  Scanner scanner(world.body(robot), ranges_m);
  scanner.meet_walls(world.walls().planes);  // each wall ends where the next one begins
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
  for (double& range : ranges_m)
    range = limited_to_lidar(range);
  if (half_width_m == 0) return;
  std::uint64_t index = static_cast<std::uint64_t>(cycle) * kLidarRays;
  for (double& range : ranges_m) {
    if (std::isfinite(range)) {
      range = limited_to_lidar(range + noise.at(index).uniform(-half_width_m, half_width_m));
    }
    ++index;
  }
}

}  // namespace swarmsmith
