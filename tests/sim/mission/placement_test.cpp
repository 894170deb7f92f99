#include <algorithm>
#include <array>
#include <cmath>

#include "base/math.h"
#include "base/overloaded.h"
#include "sim/mission/mission.h"
#include "sim/mission/polygon.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

/// Points of a solid's border and inside, in the arena: enough to see that two solids overlap or
/// that one reaches through a wall, without the code under test.
std::vector<Point> points_of(const Outline& outline, const Pose& pose) {
  std::vector<Point> own;
  const auto along = [&own](const std::vector<Point>& corners) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Point from = corners[i];
      const Point to = corners[(i + 1) % corners.size()];
      for (int k = 0; k < 12; ++k) {
        const double t = k / 12.0;
        for (const double inwards : {1.0, 0.5}) {
          own.push_back(
              {inwards * (from.x + t * (to.x - from.x)), inwards * (from.y + t * (to.y - from.y))});
        }
      }
    }
  };
  std::visit(Overloaded{[&](const CircleOutline& circle) {
                          along(regular_polygon(24, circle.radius_m * std::cos(kPi / 24)));
                        },
                        [&](const BoxOutline& box) {
                          const double x = box.length_m / 2;
                          const double y = box.width_m / 2;
                          along({{x, y}, {-x, y}, {-x, -y}, {x, -y}});
                        },
                        [&](const PolygonOutline& polygon) { along(polygon.corners); }},
             outline);
  for (Point& point : own) {
    point = {pose.x + point.x * std::cos(pose.theta) - point.y * std::sin(pose.theta),
             pose.y + point.x * std::sin(pose.theta) + point.y * std::cos(pose.theta)};
  }
  return own;
}

/// Whether the point lies in the solid, by more than rounding.
bool is_in(const Outline& outline, const Pose& pose, Point point) {
  const double dx = point.x - pose.x;
  const double dy = point.y - pose.y;
  const Point own = {dx * std::cos(pose.theta) + dy * std::sin(pose.theta),
                     dy * std::cos(pose.theta) - dx * std::sin(pose.theta)};
  return std::visit(
      Overloaded{[&](const CircleOutline& circle) {
                   return std::hypot(own.x, own.y) < circle.radius_m - 1e-9;
                 },
                 [&](const BoxOutline& box) {
                   return std::fabs(own.x) < box.length_m / 2 - 1e-9 &&
                          std::fabs(own.y) < box.width_m / 2 - 1e-9;
                 },
                 [&](const PolygonOutline& polygon) {
                   return is_within(polygon.corners, {own.x * (1 + 1e-9), own.y * (1 + 1e-9)});
                 }},
      outline);
}

/// Two rooms with a door, obstacles and an object of every shape.
Mission crowded(const Outline& body) {
  Mission mission{.name = "crowded", .arena = {}, .shuffled = {}, .rule = RobotsOn{}};
  mission.arena.walls = walls_around({{-2.2, -1},
                                      {-0.2, -1},
                                      {-0.2, -0.3},
                                      {0.2, -0.3},
                                      {0.2, -1},
                                      {2.2, -1},
                                      {2.2, 1},
                                      {0.2, 1},
                                      {0.2, 0.3},
                                      {-0.2, 0.3},
                                      {-0.2, 1},
                                      {-2.2, 1}});
  const Outline triangle = PolygonOutline{{{0.2, 0}, {-0.1, 0.2}, {-0.1, -0.2}}};
  mission.arena.obstacles = {{CircleOutline{0.2}, {-1.2, 0.4, 0}},
                             {BoxOutline{0.8, 0.1}, {1, 0.2, 1}},
                             {triangle, {-1.4, -0.5, 0.7}}};
  mission.arena.objects = {{BoxOutline{0.3, 0.5}, {1.6, -0.5, 0.3}}};
  mission.robot.body.outline = body;
  mission.robots = 5;
  mission.placement = PlaceAnywhere{};
  return mission;
}

TEST(Placement, KeepsBodiesOfEveryShapeClearOfEverything) {
  const Outline bodies[] = {BoxOutline{0.286, 0.286}, CircleOutline{0.15}, BoxOutline{0.4, 0.15},
                            PolygonOutline{{{0.2, 0}, {-0.1, 0.15}, {-0.1, -0.15}}}};
  for (const Outline& body : bodies) {
    const Mission mission = crowded(body);
    const std::vector<Point> corners = corners_of(mission.arena);
    std::vector<std::pair<Outline, Pose>> things;
    for (const Obstacle& obstacle : mission.arena.obstacles)
      things.emplace_back(obstacle.outline, obstacle.pose);
    for (const MovableObject& object : mission.arena.objects)
      things.emplace_back(object.outline, object.start);
    for (int seed = 1; seed <= 100; ++seed) {
      std::vector<std::pair<Outline, Pose>> all = things;
      const Instance instance = instance_of(mission, seed).value();
      for (const Pose& pose : instance.starts)
        all.emplace_back(body, pose);
      ASSERT_LT(things.size(), all.size());
      for (std::size_t i = things.size(); i < all.size(); ++i) {
        for (const Point point : points_of(all[i].first, all[i].second)) {
          ASSERT_TRUE(is_within(corners, point)) << "seed " << seed;
          for (std::size_t j = 0; j < i; ++j)
            ASSERT_FALSE(is_in(all[j].first, all[j].second, point)) << "seed " << seed;
        }
        for (std::size_t j = 0; j < i; ++j) {
          for (const Point point : points_of(all[j].first, all[j].second))
            ASSERT_FALSE(is_in(all[i].first, all[i].second, point)) << "seed " << seed;
        }
      }
    }
  }
}

TEST(Placement, AnywhereIsUniformOverTheArena) {
  // Of one small robot in an L of three unit squares, each square gets a third of the starts.
  Mission mission{.name = "l", .arena = {}, .shuffled = {}, .rule = RobotsOn{}};
  mission.arena.walls = walls_around({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}});
  mission.robot.body.outline = CircleOutline{0.001};
  mission.robots = 1;
  mission.placement = PlaceAnywhere{};
  std::array<int, 3> counts{};
  constexpr int kRuns = 6000;
  for (int seed = 1; seed <= kRuns; ++seed) {
    const Pose pose = instance_of(mission, seed).value().starts[0];
    ++counts[pose.x > 1 ? 1 : (pose.y > 1 ? 2 : 0)];
  }
  double chi_square = 0;
  for (const int count : counts)
    chi_square += (count - kRuns / 3.0) * (count - kRuns / 3.0) / (kRuns / 3.0);
  EXPECT_LT(chi_square, 9.21);  // 1 % of chi-square with two degrees of freedom
}

TEST(Placement, InARectangleIsUniformInIt) {
  Mission mission = built_in_mission("aggregation").value();
  mission.robot.body.outline = CircleOutline{0.001};
  mission.robots = 1;
  mission.placement = PlaceInRectangle{{{0.2, -0.1}, 1.0, 0.4}};
  std::array<int, 8> counts{};
  constexpr int kRuns = 4000;
  for (int seed = 1; seed <= kRuns; ++seed) {
    const Pose pose = instance_of(mission, seed).value().starts[0];
    ASSERT_LE(std::fabs(pose.x - 0.2), 0.5);
    ASSERT_LE(std::fabs(pose.y + 0.1), 0.2);
    const int column = static_cast<int>((pose.x + 0.3) / 0.25);
    ++counts[static_cast<std::size_t>(column + (pose.y > -0.1 ? 4 : 0))];
  }
  double chi_square = 0;
  for (const int count : counts)
    chi_square += (count - kRuns / 8.0) * (count - kRuns / 8.0) / (kRuns / 8.0);
  EXPECT_LT(chi_square, 18.48);  // 1 %, seven degrees of freedom
}

TEST(Placement, InADiscElsewhereDrawsTheSamePlacesAroundItsCentre) {
  Mission mission = built_in_mission("aggregation").value();
  mission.robots = 1;
  mission.placement = PlaceInDisc{.centre = {}, .radius_m = 0.4};
  const Pose at_middle = instance_of(mission, 3).value().starts[0];
  mission.placement = PlaceInDisc{.centre = {0.25, -0.5}, .radius_m = 0.4};
  const Pose elsewhere = instance_of(mission, 3).value().starts[0];
  EXPECT_DOUBLE_EQ(elsewhere.x, at_middle.x + 0.25);
  EXPECT_DOUBLE_EQ(elsewhere.y, at_middle.y - 0.5);
  EXPECT_EQ(elsewhere.theta, at_middle.theta);
}

TEST(Placement, AtFixedPosesIsTheSameForEverySeed) {
  Mission mission = built_in_mission("color_selection").value();
  mission.placement = PlaceAt{{{0, 0, 1}, {0.5, 0, 2}, {0, 0.5, 3}}};
  for (const int seed : {1, 2}) {
    EXPECT_EQ(instance_of(mission, seed).value().starts,
              std::get<PlaceAt>(mission.placement).poses);
  }
  EXPECT_NE(instance_of(mission, 1).value().patches, instance_of(mission, 2).value().patches);
}

TEST(Placement, AtFixedPosesWithoutRoomIsAnErrorThatNamesWhatIsInTheWay) {
  const auto error = [](const Pose& pose) {
    Mission mission = crowded(BoxOutline{0.286, 0.286});
    mission.robots = 1;
    mission.placement = PlaceAt{{pose}};
    const auto instance = instance_of(mission, 1);
    return instance ? "" : instance.error().message;
  };
  EXPECT_EQ(error({1.5, 0.7, 0}), "");
  EXPECT_THAT(error({0, 0.25, 0}), HasSubstr("would stand in a wall"));  // in the door's frame
  EXPECT_THAT(error({5, 0, 0}), HasSubstr("would stand in a wall"));
  EXPECT_THAT(error({-1.2, 0.1, 0}), HasSubstr("would stand in obstacle 1"));
  EXPECT_THAT(error({1.1, 0.3, 0}), HasSubstr("would stand in obstacle 2"));
  EXPECT_THAT(error({1.5, -0.3, 0}), HasSubstr("would stand in object 1"));
}

TEST(Placement, MayIgnoreObstacles) {
  Mission mission = built_in_mission("aggregation").value();
  mission.arena.obstacles = {{.outline = BoxOutline{0.8, 0.8}, .pose = {}}};
  const auto starts_in_it = [&] {
    int count = 0;
    for (std::int64_t seed = 1; seed <= 20; ++seed) {
      const Instance instance = value_of(instance_of(mission, seed));
      EXPECT_FALSE(has_overlaps(mission, instance));
      count += static_cast<int>(std::ranges::count_if(instance.starts, [](const Pose& pose) {
        return is_in(BoxOutline{0.8, 0.8}, {}, pose.position());
      }));
    }
    return count;
  };
  EXPECT_EQ(starts_in_it(), 0);
  mission.ignores_obstacles = true;
  EXPECT_GT(starts_in_it(), 0);
}

TEST(MisplacedSolid, IsNamed) {
  Arena arena = crowded(CircleOutline{0.1}).arena;
  EXPECT_EQ(misplaced_solid(arena), std::nullopt);
  arena.obstacles[1].pose.x = 0.5;
  arena.obstacles[1].pose.y = 1.4;
  EXPECT_EQ(misplaced_solid(arena), "obstacle 2 is outside the walls");
  arena = crowded(CircleOutline{0.1}).arena;
  arena.objects.push_back({CircleOutline{0.1}, {1.6, -0.4, 0}});
  EXPECT_EQ(misplaced_solid(arena), "object 2 would stand in object 1; objects need room");
}

}  // namespace
}  // namespace swarmsmith
