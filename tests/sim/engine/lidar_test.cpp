#include "sim/engine/internal/lidar.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/math.h"
#include "sim/mission/polygon.h"
#include "tests/sim/engine/plain_rays.h"
#include "tests/sim/engine/statistics.h"
#include "tests/support/not_empty.h"

namespace swarmsmith {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const Robot kRvr = rvr();

std::vector<double> scan(const World& world, int robot) {
  std::vector<double> ranges(kLidarRays, -1);
  scan_surroundings(world, robot, ranges);
  return ranges;
}

std::vector<double> turrets(const World& world, int robot) {
  std::vector<double> ranges(kLidarRays, -1);
  scan_turrets(world, Sight(world, kWallHeight_m), robot, ranges);
  return ranges;
}

Point direction_of(double theta, int ray) {
  const double angle = theta + 2 * kPi * ray / kLidarRays;
  return {std::cos(angle), std::sin(angle)};
}

/// The law of a scan, without anything that makes it quick: a face that is seen, its second corner
/// counter-clockwise of the first, is met by the rays between the angles of its corners, at its
/// area with the scanning robot by what it is across the ray.
class PlainScan {
 public:
  explicit PlainScan(const Body& self) : self_(self), ranges_(kLidarRays, kInfinity) {}

  void meet_face(const Point& from, const Point& to) {
    const double x = to.x - from.x;
    const double y = to.y - from.y;
    const double area = from.x * y - from.y * x;
    if (area <= 0) return;
    const double first = ray_through(from);
    const double end = ray_through(to);
    const double width = end - first + (end < first ? kLidarRays : 0);
    if (width > kLidarRays / 2.0) return;  // rounding of a face that is seen end-on
    const double farthest =
        std::sqrt(std::max(from.x * from.x + from.y * from.y, to.x * to.x + to.y * to.y));
    for_rays(first, first + width, [&](const RayDirection& ray) {
      const double across = ray.x * y - ray.y * x;
      return across > 0 ? std::min(area / across, farthest) : farthest;
    });
  }

  void meet_circle(const Body& at, double radius_m) {
    const Point centre = seen({at.x, at.y});
    const double tangent2 = centre.x * centre.x + centre.y * centre.y - radius_m * radius_m;
    if (tangent2 <= 0) return;
    const double half = atan2(radius_m, std::sqrt(tangent2)) * kRaysPerRadian;
    for_rays(ray_through(centre) - half, ray_through(centre) + half, [&](const RayDirection& ray) {
      const double ahead = ray.x * centre.x + ray.y * centre.y;
      const double aside = ray.x * centre.y - ray.y * centre.x;
      return ahead - std::sqrt(std::max(0.0, radius_m * radius_m - aside * aside));
    });
  }

  void meet_solid(const Form& form, const Body& at) {
    if (form.is_circle()) return meet_circle(at, form.radius_m);
    // Seen from outside, counter-clockwise corners come clockwise.
    for (const Wall& side : sides_of(form, at))
      meet_face(seen(side.to), seen(side.from));
  }

  void meet_wall(const Wall& wall) { meet_face(seen(wall.from), seen(wall.to)); }

  const std::vector<double>& ranges_m() const { return ranges_; }

 private:
  static constexpr double kRaysPerRadian = kLidarRays / (2 * kPi);

  static double ray_through(const Point& at) { return atan2(at.y, at.x) * kRaysPerRadian; }

  Point seen(const Point& place) const {
    const double dx = place.x - self_.x;
    const double dy = place.y - self_.y;
    return {self_.cos * dx + self_.sin * dy, self_.cos * dy - self_.sin * dx};
  }

  template <class Distance>
  void for_rays(double from, double to, const Distance& distance) {
    for (int i = static_cast<int>(std::ceil(from)); i <= std::floor(to); ++i) {
      const auto ray = static_cast<std::size_t>((i + kLidarRays) % kLidarRays);
      ranges_[ray] = std::min(ranges_[ray], distance(lidar_directions()[ray]));
    }
  }

  Body self_;
  std::vector<double> ranges_;
};

void expect_bits_of_plain_scan(const World& world, const Arena& arena) {
  for (int robot = 0; robot < world.robots(); ++robot) {
    PlainScan want(world.body(robot));
    for (const Wall& wall : arena.walls)
      want.meet_wall(wall);
    for (const FixedSolid& obstacle : world.obstacles())
      want.meet_solid(obstacle.form, obstacle.at);
    for (int other = 0; other < world.movers(); ++other) {
      if (other != robot) want.meet_solid(world.form(other), world.body(other));
    }
    const std::vector<double> ranges = scan(world, robot);
    for (std::size_t ray = 0; ray < kLidarRays; ++ray) {
      ASSERT_EQ(std::bit_cast<std::uint64_t>(ranges[ray]),
                std::bit_cast<std::uint64_t>(want.ranges_m()[ray]))
          << "robot " << robot << " ray " << ray << ": " << ranges[ray] << ", not "
          << want.ranges_m()[ray];
    }
  }
}

void expect_plain_scan(const World& world, const Arena& arena, const Pose& pose) {
  const std::vector<double> ranges = scan(world, 0);
  for (int ray = 0; ray < kLidarRays; ++ray) {
    const double want =
        to_anything(pose.position(), direction_of(pose.theta, ray), arena, world, 0);
    ASSERT_NEAR(ranges[static_cast<std::size_t>(ray)], want, 1e-9) << "ray " << ray;
  }
}

TEST(Lidar, MeetsWallsAndRobotsAsThePlainWayDoes) {
  const Arena arena = dodecagon_of_the_thesis();
  Rng rng(1);
  for (int i = 0; i < 100; ++i) {
    const std::vector<Pose> poses = {
        {rng.uniform(-0.3, 0.3), rng.uniform(-0.3, 0.3), rng.uniform(-kPi, kPi)},
        {rng.uniform(0.6, 1), rng.uniform(-0.3, 0.3), rng.uniform(-kPi, kPi)},
        {rng.uniform(-1, -0.6), rng.uniform(-0.3, 0.3), rng.uniform(-kPi, kPi)}};
    expect_plain_scan(World(arena, kRvr, poses, ContactModel::Exact), arena, poses[0]);
  }
}

TEST(Lidar, MeetsManyRobotsAsThePlainWayDoes) {
  // From touching to 6 m away, so that faces have from no ray to hundreds.
  const Arena arena = regular_dodecagon(60);
  Rng rng(4);
  for (int i = 0; i < 50; ++i) {
    std::vector<Pose> poses = {{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-kPi, kPi)}};
    while (poses.size() < 30) {
      const Pose pose = {rng.uniform(-3, 3), rng.uniform(-3, 3), rng.uniform(-kPi, kPi)};
      if (hypot(pose.x - poses[0].x, pose.y - poses[0].y) > kCornerRadius_m) poses.push_back(pose);
    }
    expect_plain_scan(World(arena, kRvr, poses, ContactModel::Exact), arena, poses[0]);
  }
}

TEST(Lidar, HasTheBitsOfThePlainLawInSwarms) {
  Rng rng(6);
  for (int i = 0; i < 60; ++i) {
    // From a crowd in which robots lie in each other and behind walls to one beyond the lidar's
    // sight. Some stand in lines, look along an axis, or at each other: rays that end at corners.
    const std::size_t robots = std::array{1U, 2U, 5U, 34U, 80U}[static_cast<std::size_t>(i) % 5];
    const double reach = rng.uniform(0.1, 2) * std::sqrt(static_cast<double>(robots));
    const Arena arena = regular_dodecagon(3 * reach * reach);
    std::vector<Pose> poses;
    while (poses.size() < robots) {
      Pose pose = {rng.uniform(-reach, reach), rng.uniform(-reach, reach), rng.uniform(-kPi, kPi)};
      if (i % 3 == 0 && rng.bernoulli(0.5)) pose.theta = 0;
      if (i % 3 == 0 && rng.bernoulli(0.5)) pose.y = 0;
      if (i % 3 == 1 && rng.bernoulli(0.5)) pose.theta = atan2(pose.y, pose.x);
      poses.push_back(pose);
    }
    expect_bits_of_plain_scan(World(arena, kRvr, poses, ContactModel::Exact), arena);
  }
}

/// Walls are taken two at a time; the last one of an odd number is alone.
TEST(Lidar, HasTheBitsOfThePlainLawAmongAnyNumberOfWalls) {
  Rng rng(9);
  for (const int sides : {3, 4, 5, 7, 8, 9, 13}) {
    const Arena arena{.walls = walls_around(regular_polygon(sides, 1.2)), .patches = {}};
    for (int i = 0; i < 20; ++i) {
      const std::vector<Pose> poses = {
          {rng.uniform(-0.8, 0.8), rng.uniform(-0.8, 0.8), rng.uniform(-kPi, kPi)}};
      expect_bits_of_plain_scan(World(arena, kRvr, poses, ContactModel::Exact), arena);
    }
  }
}

TEST(Lidar, HasTheBitsOfThePlainLawAmongObstaclesObjectsAndWallsThatAreNotConvex) {
  Arena arena = notched_arena();
  furnish(arena);
  const PolygonOutline triangle{{{0.1, 0}, {-0.05, 0.08}, {-0.05, -0.08}}};
  const std::array<Outline, 4> outlines = {kRvr.body.outline, CircleOutline{0.09},
                                           BoxOutline{0.3, 0.2}, triangle};
  Rng rng(7);
  for (std::size_t i = 0; i < 100; ++i) {
    std::vector<Pose> poses;
    while (poses.size() < 4)
      poses.push_back({rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-kPi, kPi)});
    expect_bits_of_plain_scan(World(arena, rvr_with(outlines[i % 4]), poses, ContactModel::Box2d),
                              arena);
  }
}

TEST(Lidar, MeetsObstaclesObjectsAndWallsThatAreNotConvex) {
  Arena arena = notched_arena();
  furnish(arena);
  Rng rng(2);
  for (int i = 0; i < 100; ++i) {
    const std::vector<Pose> poses = {
        {rng.uniform(-0.1, 0.1), rng.uniform(-0.25, -0.1), rng.uniform(-kPi, kPi)},
        {rng.uniform(-0.6, -0.4), rng.uniform(0.0, 0.1), rng.uniform(-kPi, kPi)}};
    expect_plain_scan(World(arena, rvr_with(CircleOutline{0.09}), poses, ContactModel::Box2d),
                      arena, poses[0]);
  }
}

TEST(Lidar, LooksAheadFirstAndThenCounterClockwise) {
  // The robot looks along +y: 4 m ahead, 3 m to the left, 1 m to the right.
  Arena arena;
  const std::vector<Point> corners = {{1, -2}, {1, 4}, {-3, 4}, {-3, -2}};
  for (std::size_t i = 0; i < 4; ++i)
    arena.walls.push_back({corners[i], corners[(i + 1) % 4]});
  const std::vector<Pose> poses = {{0, 0, kPi / 2}};
  const std::vector<double> ranges = scan(World(arena, kRvr, poses, ContactModel::Exact), 0);
  EXPECT_NEAR(ranges[0], 4, 1e-12);
  // Ray 180 looks 90 + 90 / 719 degrees to the left, ray 539 as much to the right.
  const double cosine = std::cos(90.0 / 719 * kPi / 180);
  EXPECT_NEAR(ranges[180], 3 / cosine, 1e-12);
  EXPECT_NEAR(ranges[539], 1 / cosine, 1e-12);
}

TEST(Lidar, NoRaySlipsThroughACornerOfTheArena) {
  const Arena arena = dodecagon_of_the_thesis();
  // Headings that put rays right onto corners, as far as numbers can.
  for (const Wall& wall : not_empty(arena.walls)) {
    for (const int ray : {0, 1, 359, 360, 718}) {
      const double theta = atan2(wall.from.y, wall.from.x) - 2 * kPi * ray / kLidarRays;
      const std::vector<Pose> poses = {{0, 0, theta}};
      const std::vector<double> ranges = scan(World(arena, kRvr, poses, ContactModel::Exact), 0);
      EXPECT_LT(*std::max_element(ranges.begin(), ranges.end()), 1.28);
    }
  }
}

TEST(Lidar, SeesOnlyTurretsWhereRobotsAreSought) {
  const Arena arena = dodecagon_of_the_thesis();
  const std::vector<Pose> poses = {{0, 0, 0.3}, {0.75, 0, 0}, {0, 0.5, 2}};
  const World world(arena, kRvr, poses, ContactModel::Exact);
  const std::vector<double> ranges = turrets(world, 0);
  int met = 0;
  for (int ray = 0; ray < kLidarRays; ++ray) {
    double want = kInfinity;
    for (const std::size_t other : {1U, 2U}) {
      want = std::min(want, to_circle({0, 0}, direction_of(0.3, ray), poses[other].position(),
                                      kTurretRadius_m));
    }
    const double got = ranges[static_cast<std::size_t>(ray)];
    ASSERT_TRUE(got == want || std::fabs(got - want) < 1e-9) << "ray " << ray;
    met += std::isfinite(got) ? 1 : 0;
  }
  // 2 asin(0.035 / d) of 360 degrees: 10.68 rays at 0.75 m, 16.03 at 0.5 m.
  EXPECT_NEAR(met, 10.68 + 16.03, 2);
}

TEST(Lidar, SaysThatLimitsChangeNothingOnlyWhereTheyDo) {
  Rng rng(5);
  int sure = 0;
  int changed = 0;
  for (int i = 0; i < 300; ++i) {
    // From crowded to so wide that walls are out of sight.
    const double area = i % 3 == 0 ? 6 : i % 3 == 1 ? 40 : 700;
    const Arena arena = regular_dodecagon(area);
    const double reach = 0.4 * std::sqrt(area);
    std::vector<Pose> poses;
    while (poses.size() < 6) {
      poses.push_back(
          {rng.uniform(-reach, reach), rng.uniform(-reach, reach), rng.uniform(-kPi, kPi)});
    }
    const World world(arena, kRvr, poses, ContactModel::Exact);
    std::vector<double> ranges(kLidarRays);
    const bool within = scan_surroundings(world, 0, ranges);
    std::vector<double> limited = ranges;
    add_lidar_noise(limited, 0, {}, 0);
    if (within) {
      EXPECT_EQ(limited, ranges) << i;
    }
    sure += within ? 1 : 0;
    changed += limited != ranges ? 1 : 0;
  }
  EXPECT_GT(sure, 100);
  EXPECT_GT(changed, 50);
}

TEST(Lidar, LimitsAreItsRange) {
  std::vector<double> ranges(kLidarRays, 1.0);
  ranges[0] = 0.0999;
  ranges[1] = 0.10;
  ranges[2] = 12;
  ranges[3] = 12.001;
  ranges[4] = kInfinity;
  add_lidar_noise(ranges, 0, NoiseStream(), 1);
  EXPECT_EQ(ranges[0], -kInfinity);
  EXPECT_EQ(ranges[1], 0.10);
  EXPECT_EQ(ranges[2], 12);
  EXPECT_EQ(ranges[3], kInfinity);
  EXPECT_EQ(ranges[4], kInfinity);
  EXPECT_EQ(ranges[5], 1.0);
}

TEST(LidarNoise, IsUniformAndAnotherForEachRayAndCycle) {
  const NoiseStream noise(Rng(3), "lidar", 0);
  std::vector<double> errors;
  for (int cycle = 1; cycle <= 20; ++cycle) {
    std::vector<double> ranges(kLidarRays, 1.0);
    add_lidar_noise(ranges, 0.01, noise, cycle);
    for (const double range : ranges)
      errors.push_back(range - 1.0);
  }
  EXPECT_LT(ks_statistic(errors, [](double x) { return (x + 0.01) / 0.02; }), kKsLimit);
  std::sort(errors.begin(), errors.end());
  EXPECT_EQ(std::adjacent_find(errors.begin(), errors.end()), errors.end());
}

TEST(LidarNoise, ComesBeforeTheLimits) {
  const NoiseStream noise(Rng(4), "lidar", 0);
  std::vector<double> ranges(kLidarRays, 0.105);
  std::fill(ranges.begin() + 300, ranges.end(), 11.995);
  add_lidar_noise(ranges, 0.01, noise, 1);
  const auto near = std::count(ranges.begin(), ranges.begin() + 300, -kInfinity);
  const auto far = std::count(ranges.begin() + 300, ranges.end(), kInfinity);
  EXPECT_LT(std::fabs(binomial_z(static_cast<double>(near), 300, 0.25)), 3.3);
  EXPECT_LT(std::fabs(binomial_z(static_cast<double>(far), 419, 0.25)), 3.3);
}

}  // namespace
}  // namespace swarmsmith
