#include "sim/engine/internal/lidar.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "base/math.h"
#include "sim/engine/internal/two.h"

namespace swarmsmith {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRaysPerRadian = kLidarRays / (2 * kPi);

/// The (real-valued) number of the ray through a point in the scanning robot's frame, in (-359.5,
/// 359.5].
double ray_through(const Point& at) {
  return atan2(at.y, at.x) * kRaysPerRadian;
}

/// A robot this far beyond the line of a face certainly sees the face; a robot this far behind it
/// certainly does not.
constexpr double kSurelyBeyond_m = 1e-6;

/// Rays from the fast approximation are wrong by less than half of this.
constexpr double kQuickError = 4.5e-4;

/// The same within `kQuickError`, for two points. It uses the arc tangent on [-1, 1], which
/// measures the angle from the diagonal of the quadrant, by the minimax odd polynomial of degree 11
/// (error 1.7e-6; Remez exchange).
Two quick_rays_through(Two x, Two y) {
  const Two ax = size_of(x);
  const Two ay = size_of(y);
  const Two u = (ax - ay) / (ax + ay + std::numeric_limits<double>::min());
  const Two s = u * u;
  const Two arc =
      u * (0.999977219 +
           s * (-0.332622828 +
                s * (0.193540376 + s * (-0.116426482 + s * (0.052647351 + s * -0.011719136)))));
  return with_sign(kPi / 2 - with_sign(kPi / 4 + arc, x), y) * kRaysPerRadian;
}

/// Distance of numbers below 2^51 from the nearest integers.
Two beside_whole(Two x) {
  constexpr double kUnitsAreLast = 0x1.8p52;  // beyond it there are no fractions
  return size_of(x - ((x + kUnitsAreLast) - kUnitsAreLast));
}

/// The rays from one position counter-clockwise to another, which may be beyond the last ray.
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

/// Points in the scanning robot's frame, computed in pairs.
class Corners {
 public:
  /// Removes all points, and reserves space for this many.
  void start(std::size_t corners) {
    count_ = 0;
    if (2 * pairs_.size() < corners) pairs_.resize((corners + 1) / 2);
  }
  /// Adds two points of the world.
  void add(const Body& self, Two x, Two y) {
    const Two dx = x - self.x;
    const Two dy = y - self.y;
    Pair& pair = pairs_[count_ / 2];
    pair.x = self.cos * dx + self.sin * dy;
    pair.y = self.cos * dy - self.sin * dx;
    pair.distance2 = pair.x * pair.x + pair.y * pair.y;
    pair.quick_ray = quick_rays_through(pair.x, pair.y);
    pair.beside_whole = beside_whole(pair.quick_ray);
    count_ += 2;
  }

  Point at(std::size_t i) const { return {pairs_[i / 2].x[i % 2], pairs_[i / 2].y[i % 2]}; }
  double distance2(std::size_t i) const { return pairs_[i / 2].distance2[i % 2]; }

  /// The rays between two points by the fast approximation. Only the integers between the two ends
  /// matter, so the result is right if no integer and no other limit is too close: `is_sure` tells.
  Sweep quick_sweep(std::size_t from, std::size_t to) const {
    return sweep_between(quick_ray(from), quick_ray(to));
  }
  bool is_sure(const Sweep& quick, std::size_t from, std::size_t to) const {
    return is_sure(from) && is_sure(to) && quick.width > 2 * kQuickError &&
           quick.width < kLidarRays / 2.0 - 2 * kQuickError;
  }
  Sweep exact_sweep(std::size_t from, std::size_t to) const {
    return sweep_between(ray_through(at(from)), ray_through(at(to)));
  }

 private:
  struct Pair {
    Two x;
    Two y;
    Two distance2;
    Two quick_ray;
    Two beside_whole;
  };

  double quick_ray(std::size_t i) const { return pairs_[i / 2].quick_ray[i % 2]; }
  bool is_sure(std::size_t i) const { return pairs_[i / 2].beside_whole[i % 2] >= kQuickError; }

  std::vector<Pair> pairs_;
  std::size_t count_ = 0;
};

/// The directions of the rays, one array per coordinate, so that several rays are computed at once.
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

/// Distances between these are within the lidar's limits despite rounding.
constexpr double kSurelyFar_m = kLidarLeast_m + 1e-6;
constexpr double kSurelySeen_m = kLidarMost_m - 1e-6;

/// Faces of two robots: the segments between two corners, and twice the areas of their triangles
/// with the scanning robot.
struct TwoFaces {
  Two edge_x;
  Two edge_y;
  Two area;
};

/// Two robots as seen in a scan: their one or two visible faces, and the range of rays that hit
/// these faces.
struct TwoRobots {
  TwoFaces right;
  TwoFaces left;
  Two border;  ///< rays before it hit the right face
  std::array<int, 2> first;
  std::array<int, 2> last;   ///< may be beyond the last ray
  std::array<bool, 2> sure;  ///< whether all of this is certain
  std::array<bool, 2> within_limits;
};

/// Points in the scanning robot's frame.
struct TwoPoints {
  Two x;
  Two y;
};

TwoFaces faces_between(const TwoPoints& from, const TwoPoints& to) {
  const Two edge_x = to.x - from.x;
  const Two edge_y = to.y - from.y;
  return {edge_x, edge_y, from.x * edge_y - from.y * edge_x};
}

/// Computes two RVRs without a branch: the set of visible corners differs from robot to robot.
TwoRobots look_at(const Body& self, const Body& one, const Body& other) {
  const Two at_x = {one.x, other.x};
  const Two at_y = {one.y, other.y};
  const Two cosine = {one.cos, other.cos};
  const Two sine = {one.sin, other.sin};
  // The position of the scanning robot in their frames tells which of their faces it sees.
  const Two from_x = self.x - at_x;
  const Two from_y = self.y - at_y;
  const Two ahead = cosine * from_x + sine * from_y;
  const Two aside = cosine * from_y - sine * from_x;
  const Two beyond_x = size_of(ahead) - kHalfSide_m;
  const Two beyond_y = size_of(aside) - kHalfSide_m;
  const Two x = with_sign(both(kHalfSide_m), ahead);
  const Two y = with_sign(both(kHalfSide_m), aside);
  const auto corners = [&](Two corner_x, Two corner_y) {
    const Two dx = at_x + cosine * corner_x - sine * corner_y - self.x;
    const Two dy = at_y + sine * corner_x + cosine * corner_y - self.y;
    return TwoPoints{self.cos * dx + self.sin * dy, self.cos * dy - self.sin * dx};
  };
  // A face that is not visible gets zero width: both its corners are the middle one.
  const TwoBits sees_x = beyond_x > 0;
  const TwoBits sees_y = beyond_y > 0;
  const TwoBits same = x * y > 0;
  const TwoPoints right = corners(turned_where(sees_y & same, x), turned_where(sees_x & ~same, y));
  const TwoPoints middle = corners(x, y);
  const TwoPoints left = corners(turned_where(sees_y & ~same, x), turned_where(sees_x & same, y));
  constexpr double kTurn = kLidarRays;
  const auto upwards = [](Two ray) { return ray + only_where(ray < 0, both(kTurn)); };
  const Two right_ray = upwards(quick_rays_through(right.x, right.y));
  const Two middle_ray = quick_rays_through(middle.x, middle.y);
  const Two left_ray = quick_rays_through(left.x, left.y);
  const Two right_width = upwards(middle_ray - right_ray);
  const Two left_width = upwards(left_ray - middle_ray);
  // If the corners are clearly between rays, a face that contains a ray is at least twice as wide
  // as that distance.
  const Two beside =
      lesser(beside_whole(middle_ray), lesser(beside_whole(right_ray), beside_whole(left_ray)));
  const TwoBits sure =
      (beside >= kQuickError) & (greater(right_width, left_width) < kTurn / 2 - 2 * kQuickError) &
      (lesser(size_of(beyond_x), size_of(beyond_y)) > kSurelyBeyond_m) & (sees_x | sees_y);
  const Two distance2 = from_x * from_x + from_y * from_y;
  constexpr double kNear_m = kCornerRadius_m + kSurelyFar_m;
  constexpr double kFar_m = kSurelySeen_m - kCornerRadius_m;
  const TwoBits within = (distance2 >= kNear_m * kNear_m) & (distance2 <= kFar_m * kFar_m);
  const Two border = right_ray + right_width;
  const Two end = border + left_width;
  return {.right = faces_between(right, middle),
          .left = faces_between(middle, left),
          .border = border,
          .first = {static_cast<int>(right_ray[0]) + 1, static_cast<int>(right_ray[1]) + 1},
          .last = {static_cast<int>(end[0]), static_cast<int>(end[1])},
          .sure = {sure[0] != 0, sure[1] != 0},
          .within_limits = {within[0] != 0, within[1] != 0}};
}

/// A scan in progress.
class Scanner {
 public:
  Scanner(const Body& self, std::span<double> ranges_m) : self_(self), ranges_(ranges_m.data()) {}

  /// Adds walls: faces that are visible only from their left, each from one corner to the next.
  /// Must be called before the other functions.
  void meet_walls(const std::vector<WallPlane>& walls) {
    const std::size_t n = walls.size();
    start_faces(n);
    for (std::size_t i = 0; i < n; i += 2) {
      const Point& first = walls[i].from;
      const Point& second = walls[std::min(i + 1, n - 1)].from;
      corners_.add(self_, Two{first.x, second.x}, Two{first.y, second.y});
    }
    for (std::size_t i = 0; i < n; ++i) {
      add_face(i, i + 1 < n ? i + 1 : 0);
      within_limits_ &= corners_.distance2(i) <= kSurelySeen_m * kSurelySeen_m;
    }
    bool far = true;
    for (std::size_t i = 0; i < seen_; ++i) {
      const Face& face = faces_[i];
      const double edge2 = face.edge.x * face.edge.x + face.edge.y * face.edge.y;
      far &= face.area * face.area >= kSurelyFar_m * kSurelyFar_m * edge2;
    }
    within_limits_ &= far;
    if (far && are_all_around(n)) {
      for (std::size_t i = 0; i < n; ++i)
        end_at_face(faces_[i]);
    } else {
      std::fill_n(ranges_, kLidarRays, kInfinity);
      meet_faces();
    }
  }

  /// Adds other robots, RVRs: body(i) for i from 0 to `many` - 1. A few dozen are prepared before
  /// the rays of the first are computed. We cannot predict how many rays will hit a robot, and a
  /// wrong guess would waste the work already started on the next robot's corners.
  template <class Bodies>
  void meet_robots(int many, const Bodies& body) {
    constexpr int kTogether = 32;
    std::array<TwoRobots, kTogether / 2> seen;
    for (int begin = 0; begin < many; begin += kTogether) {
      const int end = std::min(begin + kTogether, many);
      for (int i = begin; i < end; i += 2)
        seen[static_cast<std::size_t>(i - begin) / 2] =
            look_at(self_, body(i), body(std::min(i + 1, end - 1)));
      for (int i = begin; i < end; ++i)
        meet_robot(seen[static_cast<std::size_t>(i - begin) / 2], (i - begin) % 2, body(i));
    }
  }

  void meet_solid(const Form& form, const Body& at) {
    const double distance2 = distance2_of(self_, at);
    const double near = form.radius_m + kSurelyFar_m;
    const double far = kSurelySeen_m - form.radius_m;
    within_limits_ &= distance2 >= near * near && far > 0 && distance2 <= far * far;
    if (form.is_circle()) return meet_circle(at, form.radius_m);
    const std::size_t n = form.corners.size();
    start_faces(n);
    for (std::size_t i = 0; i < n; i += 2) {
      const Point& first = form.corners[i];
      const Point& second = form.corners[std::min(i + 1, n - 1)];
      const Two x = {first.x, second.x};
      const Two y = {first.y, second.y};
      corners_.add(self_, at.x + at.cos * x - at.sin * y, at.y + at.sin * x + at.cos * y);
    }
    // Corners are counter-clockwise, so that the outside is on the right of each face.
    for (std::size_t i = 0; i < n; ++i)
      add_face(i + 1 < n ? i + 1 : 0, i);
    meet_faces();
  }

  /// Whether all distances so far are certain to be within the lidar's limits.
  bool is_within_limits() const { return within_limits_; }

  /// Adds a circle; like polygons, it is not hit from inside.
  void meet_circle(const Body& at, double radius_m) {
    const double dx = at.x - self_.x;
    const double dy = at.y - self_.y;
    const Point centre = {self_.cos * dx + self_.sin * dy, self_.cos * dy - self_.sin * dx};
    const double distance2 = centre.x * centre.x + centre.y * centre.y;
    const double tangent2 = distance2 - radius_m * radius_m;
    if (tangent2 <= 0) return;
    const double half = atan2(radius_m, std::sqrt(tangent2)) * kRaysPerRadian;
    const double ray = ray_through(centre);
    for_stretches(ray - half, ray + half, [&](int first, int last, int /*shift*/) {
      for (int i = first; i <= last; ++i) {
        const double ahead = x_[i] * centre.x + y_[i] * centre.y;
        const double aside = x_[i] * centre.y - y_[i] * centre.x;
        const double distance =
            ahead - std::sqrt(std::max(0.0, radius_m * radius_m - aside * aside));
        ranges_[i] = distance < ranges_[i] ? distance : ranges_[i];
      }
    });
  }

 private:
  /// The segment between two corners.
  struct Face {
    std::size_t first;
    std::size_t second;
    Point edge;
    double area;
  };

  void start_faces(std::size_t most) {
    corners_.start(most);
    if (faces_.size() < most) faces_.resize(most);
    seen_ = 0;
  }

  /// A face is visible when its second corner lies counter-clockwise of the first. It is always
  /// written but only counted if visible, because which faces of a square are visible is
  /// unpredictable.
  void add_face(std::size_t first, std::size_t second) {
    const Point from = corners_.at(first);
    const Point to = corners_.at(second);
    Face& face = faces_[seen_];
    face.first = first;
    face.second = second;
    face.edge = {to.x - from.x, to.y - from.y};
    face.area = from.x * face.edge.y - from.y * face.edge.x;
    seen_ += face.area > 0 ? 1 : 0;
  }

  void meet_faces() {
    for (std::size_t i = 0; i < seen_; ++i)
      meet_face(faces_[i]);
  }

  /// Whether each ray certainly ends at one of the faces, with no ray near a corner.
  bool are_all_around(std::size_t faces) const {
    if (faces != seen_) return false;
    bool sure = true;
    int rays = 0;
    for (std::size_t i = 0; i < faces; ++i) {
      const Sweep sweep = corners_.quick_sweep(faces_[i].first, faces_[i].second);
      sure &= corners_.is_sure(sweep, faces_[i].first, faces_[i].second);
      rays += floor_of(sweep.from + sweep.width) - floor_of(sweep.from);
    }
    return sure && rays == kLidarRays;
  }

  /// For faces for which `are_all_around` is true: there is no nearer hit so far, and each ray ends
  /// within its face, as in meet_robot.
  void end_at_face(const Face& face) {
    const Sweep sweep = corners_.quick_sweep(face.first, face.second);
    const Two edge_x = both(face.edge.x);
    const Two edge_y = both(face.edge.y);
    const Two area = both(face.area);
    for_stretches(sweep.from, sweep.from + sweep.width, [&](int first, int last, int /*shift*/) {
      int i = first;
      for (; i < last; i += 2)
        store_two(area / (load_two(x_ + i) * edge_y - load_two(y_ + i) * edge_x), ranges_ + i);
      if (i == last) ranges_[i] = face.area / (x_[i] * face.edge.y - y_[i] * face.edge.x);
    });
  }

  /// No ray is near a corner here or parallel to a face, so each ray ends within its face. The
  /// farther corner, which limits distances in meet_face, is farther by at least 1e-12 of the
  /// distance, and rounding errors are far smaller.
  void meet_robot(const TwoRobots& two, int which, const Body& at) {
    within_limits_ &= two.within_limits[static_cast<std::size_t>(which)];
    if (!two.sure[static_cast<std::size_t>(which)]) [[unlikely]]
      return meet_solid(rvr_form(), at);
    const Two right_x = both(two.right.edge_x[which]);
    const Two right_y = both(two.right.edge_y[which]);
    const Two right_area = both(two.right.area[which]);
    const Two left_x = both(two.left.edge_x[which]);
    const Two left_y = both(two.left.edge_y[which]);
    const Two left_area = both(two.left.area[which]);
    const auto meet = [&](int first, int last, double border) {
      const auto meet_one = [&](Two before, Two x, Two y, Two range) {
        const auto is_right = before > 0;
        const Two edge_x = is_right ? right_x : left_x;
        const Two edge_y = is_right ? right_y : left_y;
        const Two area = is_right ? right_area : left_area;
        return lesser(range, area / (x * edge_y - y * edge_x));
      };
      const auto meet_two = [&](int i, Two before) {
        store_two(meet_one(before, load_two(x_ + i), load_two(y_ + i), load_two(ranges_ + i)),
                  ranges_ + i);
      };
      // Always computed alone, because whether it has a partner is unpredictable.
      const Two last_met =
          meet_one(both(border - last), both(x_[last]), both(y_[last]), both(ranges_[last]));
      Two before = border - first - Two{0, 1};
      for (int i = first; i < last; i += 2, before -= 2.0)
        meet_two(i, before);
      ranges_[last] = last_met[0];
    };
    const int first = two.first[static_cast<std::size_t>(which)];
    const int last = two.last[static_cast<std::size_t>(which)];
    if (last < kLidarRays) [[likely]] {
      if (first <= last) meet(first, last, two.border[which]);
    } else {
      if (first < kLidarRays) meet(first, kLidarRays - 1, two.border[which]);
      meet(std::max(first - kLidarRays, 0), last - kLidarRays, two.border[which] - kLidarRays);
    }
  }

  /// Neighbouring faces end at the same position between two rays, so that no ray passes between
  /// them.
  void meet_face(const Face& face) {
    const Sweep quick = corners_.quick_sweep(face.first, face.second);
    const Sweep sweep = corners_.is_sure(quick, face.first, face.second)
                            ? quick
                            : corners_.exact_sweep(face.first, face.second);
    // The face is seen edge-on: rounding has swapped the order of the corners.
    if (sweep.width > kLidarRays / 2.0) return;
    const Point edge = face.edge;
    const double area = face.area;
    // For a ray along the face the quotient is inaccurate, but it ends at the farther corner at the
    // latest.
    const Two farthest =
        both(std::sqrt(std::max(corners_.distance2(face.first), corners_.distance2(face.second))));
    const auto meet = [=](Two x, Two y, Two range) {
      const Two across = x * edge.y - y * edge.x;
      return lesser(range, across > 0 ? lesser(area / across, farthest) : farthest);
    };
    const auto meet_two = [=, this](int i) {
      store_two(meet(load_two(x_ + i), load_two(y_ + i), load_two(ranges_ + i)), ranges_ + i);
    };
    for_stretches(sweep.from, sweep.from + sweep.width, [&](int first, int last, int /*shift*/) {
      if (first == last) {
        ranges_[last] = meet(both(x_[last]), both(y_[last]), both(ranges_[last]))[0];
      } else {
        for (int i = first; i < last - 1; i += 2)
          meet_two(i);
        meet_two(last - 1);  // repeating a ray does not change its distance
      }
    });
  }

  /// Calls act(first, last, shift) for the rays from one position, in [-719, 718], to another less
  /// than a turn farther, both included; it makes two calls if they continue past the last ray. The
  /// number of the ray is the position plus the shift.
  template <class Act>
  static void for_stretches(double from, double to, const Act& act) {
    const int around = from > -1 ? 0 : kLidarRays;
    const int first = ceil_of(from) + around;
    const int last = floor_of(to) + around;
    if (first > last) return;
    act(first, std::min(last, kLidarRays - 1), around);
    if (last >= kLidarRays) [[unlikely]]
      act(0, last - kLidarRays, around - kLidarRays);
  }

  const Body& self_;
  double* ranges_;
  const double* x_ = directions_by_coordinate().x.data();
  const double* y_ = directions_by_coordinate().y.data();
  Corners corners_;
  std::vector<Face> faces_;
  std::size_t seen_ = 0;  ///< number of visible faces; they come first
  bool within_limits_ = true;
};

double limited_to_lidar(double distance_m) {
  const double seen = distance_m > kLidarMost_m ? kInfinity : distance_m;
  return distance_m < kLidarLeast_m ? -kInfinity : seen;
}

}  // namespace

bool scan_surroundings(const World& world, int robot, std::span<double> ranges_m) {
  Scanner scanner(world.body(robot), ranges_m);
  scanner.meet_walls(world.walls().planes);  // each wall ends where the next one begins
  for (const FixedSolid& obstacle : world.obstacles()) {
    if (obstacle.form.height_m >= kLidarHeight_m) scanner.meet_solid(obstacle.form, obstacle.at);
  }
  int objects = 0;
  if (world.form(robot).is_rvr) {
    scanner.meet_robots(world.robots() - 1,
                        [&](int i) -> const Body& { return world.body(i < robot ? i : i + 1); });
    objects = world.robots();
  }
  for (int mover = objects; mover < world.movers(); ++mover) {
    if (mover == robot || world.form(mover).height_m < kLidarHeight_m) continue;
    scanner.meet_solid(world.form(mover), world.body(mover));
  }
  return scanner.is_within_limits();
}

void scan_turrets(const World& world, const Sight& sight, int robot, std::span<double> ranges_m) {
  std::fill(ranges_m.begin(), ranges_m.end(), kInfinity);
  Scanner scanner(world.body(robot), ranges_m);
  std::vector<int> room;
  for (int other = 0; other < world.robots(); ++other) {
    if (other == robot || sight.is_hidden(robot, other, room)) continue;
    scanner.meet_circle(world.body(other), kTurretRadius_m);
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
