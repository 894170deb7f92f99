#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/math.h"
#include "sim/mission/colors.h"
#include "sim/mission/mission.h"
#include "tests/support/not_empty.h"

namespace swarmsmith {
namespace {

constexpr double kHalfSide = 0.143;

std::array<Point, 4> corners(const Pose& pose) {
  std::array<Point, 4> points;
  for (std::size_t i = 0; i < 4; ++i) {
    const double x = i % 2 == 0 ? kHalfSide : -kHalfSide;
    const double y = i < 2 ? kHalfSide : -kHalfSide;
    points[i] = {pose.x + x * cos(pose.theta) - y * sin(pose.theta),
                 pose.y + x * sin(pose.theta) + y * cos(pose.theta)};
  }
  return points;
}

bool in_body(const Pose& pose, Point point) {
  const double dx = point.x - pose.x;
  const double dy = point.y - pose.y;
  return std::fabs(dx * cos(pose.theta) + dy * sin(pose.theta)) < kHalfSide - 1e-9 &&
         std::fabs(dy * cos(pose.theta) - dx * sin(pose.theta)) < kHalfSide - 1e-9;
}

bool in_arena(const Arena& arena, Point point) {
  return std::all_of(arena.walls.begin(), arena.walls.end(), [point](const Wall& wall) {
    return (wall.to.x - wall.from.x) * (point.y - wall.from.y) -
               (wall.to.y - wall.from.y) * (point.x - wall.from.x) >
           -1e-9;
  });
}

TEST(Instance, TheSameSeedGivesTheSamePosesInAllMissions) {
  for (const std::int64_t seed : {1, 2, 2147483647}) {
    const auto starts_in = [seed](const char* mission) {
      return instance_of(built_in_mission(mission).value(), seed).value().starts;
    };
    EXPECT_EQ(starts_in("aggregation").size(), 3U);
    EXPECT_EQ(starts_in("aggregation"), starts_in("grid_exploration"));
    EXPECT_EQ(starts_in("aggregation"), starts_in("color_selection"));
  }
}

TEST(Instance, IsAFunctionOfTheSeed) {
  const Mission mission = built_in_mission("color_selection").value();
  EXPECT_EQ(instance_of(mission, 5).value(), instance_of(mission, 5).value());
  EXPECT_NE(instance_of(mission, 5).value(), instance_of(mission, 6).value());
}

TEST(Instance, BodiesKeepClearOfWallsAndOfEachOther) {
  const Mission mission = built_in_mission("aggregation").value();
  for (int seed = 1; seed <= 2000; ++seed) {
    const Instance instance = instance_of(mission, seed).value();
    for (const Pose& pose : not_empty(instance.starts)) {
      EXPECT_GT(pose.theta, -kPi);
      EXPECT_LE(pose.theta, kPi);
      for (const Point corner : corners(pose)) {
        ASSERT_TRUE(in_arena(mission.arena, corner)) << "seed " << seed;
        for (const Pose& other : instance.starts) {
          if (other == pose) continue;
          ASSERT_FALSE(in_body(other, corner)) << "seed " << seed;
        }
      }
    }
  }
}

TEST(Instance, StartsAreSpreadOverTheWholeDisc) {
  // One robot, so that no other is in the way: uniform in the disc as long as no wall is near.
  Mission mission = built_in_mission("aggregation").value();
  mission.robots = 1;
  std::array<int, 4> quadrant{};
  int inner = 0;
  const int runs = 8000;
  int within = 0;
  for (int seed = 1; seed <= runs; ++seed) {
    const Pose pose = instance_of(mission, seed).value().starts[0];
    ++quadrant[static_cast<std::size_t>((pose.x > 0 ? 1 : 0) + (pose.y > 0 ? 2 : 0))];
    const double radius = std::hypot(pose.x, pose.y);
    if (radius < 1.0) ++within;
    if (radius < 0.5) ++inner;
  }
  for (const int count : quadrant)
    EXPECT_NEAR(count, runs / 4, 200);
  EXPECT_NEAR(inner, within / 4.0, 200);  // area grows with the square
}

TEST(Instance, AnArenaTooSmallIsAnError) {
  Mission mission = built_in_mission("aggregation").value();
  mission.robots = 40;
  const Expected<Instance> instance = instance_of(mission, 1);
  ASSERT_FALSE(instance.has_value());
  EXPECT_NE(instance.error().message.find("arena too small for 40 robots"), std::string::npos);
}

TEST(Instance, EveryColorIsLaidOnItsNumberOfPlaces) {
  const Mission mission = built_in_mission("color_selection").value();
  std::map<std::pair<double, double>, int> yellow_at;
  for (int seed = 1; seed <= 3000; ++seed) {
    const Instance instance = instance_of(mission, seed).value();
    ASSERT_EQ(instance.patches.size(), 12U);
    std::map<int, int> count;
    std::vector<Rectangle> used;
    for (const Patch& patch : instance.patches) {
      ++count[patch.color.r + 2 * patch.color.g];
      used.push_back(std::get<Rectangle>(patch.shape));
      if (patch.color == Rgb{255, 255, 0}) {
        ++yellow_at[{used.back().centre.x, used.back().centre.y}];
      }
    }
    EXPECT_EQ(count, (std::map<int, int>{{255, 4}, {510, 4}, {765, 4}}));
    for (const Rectangle& place : mission.shuffled.places) {
      EXPECT_EQ(std::count(used.begin(), used.end(), place), 1);
    }
  }
  // Each place is yellow in a third of the runs: 1000 +- 4 standard deviations of 26.
  ASSERT_EQ(yellow_at.size(), 12U);
  for (const auto& [place, count] : yellow_at)
    EXPECT_NEAR(count, 1000, 104);
}

TEST(Instance, MorePatchesThanPlacesIsAnError) {
  Mission mission = built_in_mission("color_selection").value();
  mission.shuffled.shares[0].count = 5;
  EXPECT_FALSE(instance_of(mission, 1).has_value());
}

TEST(Instance, ItsPatchesLieOverTheArenas) {
  Mission mission = built_in_mission("aggregation").value();
  const Instance instance{.starts = {}, .patches = {{Rectangle{{0, 0}, 0.1, 0.1}, {255, 0, 0}}}};
  const Arena arena = arena_of(mission, instance);
  EXPECT_EQ(floor_at(arena, {0, 0}), (Rgb{255, 0, 0}));
  EXPECT_EQ(floor_at(arena, {0.2, 0}), (Rgb{0, 0, 0}));
}

}  // namespace
}  // namespace swarmsmith
