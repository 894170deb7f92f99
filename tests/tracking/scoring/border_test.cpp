#include "tracking/scoring/border.h"

#include <cmath>

#include "base/rng.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

constexpr Rgb kRed{255, 0, 0};
constexpr Rgb kGreen{0, 255, 0};

TEST(BorderTest, OfASpotIsItsCircle) {
  const Mission mission = built_in_mission("aggregation").value();
  for (const Point point : {Point{0.3, 0.1}, Point{-0.7, 0.6}, Point{0, 0}, Point{0.5, 0}}) {
    const auto border = value_of(nearest_border(mission.rule, mission.arena, point));
    EXPECT_NEAR(border.distance_m, std::fabs(0.5 - std::hypot(point.x, point.y)), 1e-12);
    EXPECT_EQ(border.name, "black spot at (0, 0)");
    EXPECT_EQ(border.here, std::hypot(point.x, point.y) <= 0.5 ? 1 : 0);
    EXPECT_EQ(border.beyond, 1 - border.here);
  }
}

/// Color selection with one red and one green patch that touch.
Arena two_patches() {
  Arena arena = dodecagon_of_the_thesis();
  arena.patches.push_back({Rectangle{{0.25, 0.25}, 0.3, 0.3}, kRed});
  arena.patches.push_back({Rectangle{{0.55, 0.25}, 0.3, 0.3}, kGreen});
  return arena;
}

TEST(BorderTest, OfAPatchIsItsNearestSideOrCorner) {
  const ScoreRule rule = built_in_mission("color_selection")->rule;
  const Arena arena = two_patches();
  const auto inside = nearest_border(rule, arena, {0.2, 0.37});
  EXPECT_NEAR(inside->distance_m, 0.03, 1e-12);
  EXPECT_EQ(inside->name, "red patch at (0.25, 0.25)");
  EXPECT_EQ(inside->here, 1);
  EXPECT_EQ(inside->beyond, 0);
  const auto off_the_corner = nearest_border(rule, arena, {0.07, 0.04});
  EXPECT_NEAR(off_the_corner->distance_m, std::hypot(0.03, 0.06), 1e-12);
  EXPECT_EQ(off_the_corner->here, 0);
}

/// Green is worth nothing, so that its border with the floor is none.
TEST(BorderTest, IsWhereTheScoreChangesAndNotTheColour) {
  const ScoreRule rule = built_in_mission("color_selection")->rule;
  const auto on_green = nearest_border(rule, two_patches(), {0.65, 0.25});
  EXPECT_NEAR(on_green->distance_m, 0.25, 1e-12);
  EXPECT_EQ(on_green->beyond, 1);
}

TEST(BorderTest, HiddenBordersDoNotCount) {
  Arena arena = dodecagon_of_the_thesis();
  arena.patches.push_back({Rectangle{{0.25, 0.25}, 0.3, 0.3}, kRed});
  arena.patches.push_back({Disc{{0.4, 0.25}, 0.1}, kRed});  // over its right side
  const ScoreRule rule = RobotsOn{.color = kRed};
  const auto border = nearest_border(rule, arena, {0.42, 0.25});
  EXPECT_NEAR(border->distance_m, 0.08, 1e-12);
}

/// Against a search over the whole plane.
TEST(BorderTest, IsTheNearestOfAll) {
  const Mission mission = built_in_mission("color_selection").value();
  Rng rng(7);
  for (int i = 0; i < 20; ++i) {
    const Arena arena = arena_of(mission, instance_of(mission, i + 1).value());
    const Point at{rng.uniform(-1, 1), rng.uniform(-1, 1)};
    const auto share = [&](Point p) {
      Scorer scorer(mission.rule, arena);
      scorer.observe(std::span(&p, 1));
      return scorer.score();
    };
    double nearest = 9;
    constexpr double kStep_m = 0.01;
    for (int column = -120; column <= 120; ++column) {
      for (int row = -120; row <= 120; ++row) {
        const Point p{column * kStep_m, row * kStep_m};
        const double distance = std::hypot(p.x - at.x, p.y - at.y);
        if (distance < nearest && share(p) != share(at)) nearest = distance;
      }
    }
    EXPECT_NEAR(nearest_border(mission.rule, arena, at)->distance_m, nearest, 1.5 * kStep_m);
  }
}

TEST(BorderTest, IsNoneForScoresOfAllInstants) {
  const Mission grid = built_in_mission("grid_exploration").value();
  EXPECT_FALSE(nearest_border(grid.rule, grid.arena, {0, 0}));
  const Mission spot = built_in_mission("aggregation").value();
  EXPECT_FALSE(nearest_border(RobotsOn{.at = When::Sum}, spot.arena, {0, 0}));
  EXPECT_FALSE(nearest_border(RobotsOn{.color = kRed}, spot.arena, {0, 0}));
}

}  // namespace
}  // namespace swarmsmith
