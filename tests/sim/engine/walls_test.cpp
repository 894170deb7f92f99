#include "sim/engine/internal/walls.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/math.h"
#include "base/rng.h"

namespace swarmsmith {
namespace {

/// A room of 2 m by 1 m, its lower left corner in the origin.
Arena room() {
  Arena arena;
  arena.walls = {{{0, 0}, {2, 0}}, {{2, 0}, {2, 1}}, {{2, 1}, {0, 1}}, {{0, 1}, {0, 0}}};
  return arena;
}

/// The room less its upper right quarter: a reflex corner in (1, 0.5).
Arena bent_room() {
  Arena arena;
  arena.walls = {{{0, 0}, {2, 0}},   {{2, 0}, {2, 0.5}}, {{2, 0.5}, {1, 0.5}},
                 {{1, 0.5}, {1, 1}}, {{1, 1}, {0, 1}},   {{0, 1}, {0, 0}}};
  return arena;
}

TEST(Walls, NormalsPointOutwards) {
  const Walls walls = walls_of(room());
  ASSERT_EQ(walls.planes.size(), 4);
  EXPECT_EQ(walls.planes[0].ny, -1);
  EXPECT_EQ(walls.planes[1].nx, 1);
  EXPECT_EQ(walls.planes[1].offset_m, 2);
  EXPECT_EQ(walls.planes[1].length_m, 1);
  EXPECT_DOUBLE_EQ(walls.planes[1].depth_of(0.5, 0.5), 1.5);
  EXPECT_DOUBLE_EQ(walls.planes[1].along(2, 0.25), 0.25);
}

TEST(Walls, TellConvexArenasFromOthers) {
  EXPECT_TRUE(walls_of(room()).convex);
  EXPECT_FALSE(walls_of(bent_room()).convex);
  EXPECT_TRUE(walls_of(dodecagon_of_the_thesis()).convex);
}

TEST(Walls, TheClearCircleOfTheThesisArenaIsThatOfItsObliqueWalls) {
  EXPECT_NEAR(walls_of(dodecagon_of_the_thesis()).clear_radius_m, 1.22568, 1e-5);
}

TEST(Squares, SideBySideTheGapIsTheRoomBetweenTheFaces) {
  const Body a = body_at({0, 0, 0});
  EXPECT_NEAR(gap_between(a, body_at({0.3, 0.05, 0})), 0.014, 1e-15);
  EXPECT_NEAR(gap_between(a, body_at({0.1, -0.28, kPi / 2})), -0.006, 1e-15);
}

TEST(Squares, CornerAgainstFaceTheGapIsTheCornersDistance) {
  const Body a = body_at({0, 0, 0});
  const Body turned = body_at({0.4, 0, kPi / 4});
  EXPECT_NEAR(gap_between(a, turned), 0.4 - 0.143 - kCornerRadius_m, 1e-12);
}

TEST(Squares, TheGapIsTheSameSeenFromBoth) {
  Rng rng(1);
  for (int i = 0; i < 1000; ++i) {
    const Body a = body_at({0, 0, rng.uniform(-kPi, kPi)});
    const Body b = body_at({rng.uniform(0.2, 0.5), rng.uniform(-0.2, 0.2), rng.uniform(-kPi, kPi)});
    EXPECT_NEAR(gap_between(a, b), gap_between(b, a), 1e-15);
  }
}

TEST(Squares, GapToAWallIsTheNearestCorners) {
  Rng rng(2);
  const WallPlane wall = walls_of(room()).planes[1];
  for (int i = 0; i < 1000; ++i) {
    const Body body = body_at({rng.uniform(0, 2), rng.uniform(0, 1), rng.uniform(-kPi, kPi)});
    double nearest = 10;
    for (const double x : {-kHalfSide_m, kHalfSide_m}) {
      for (const double y : {-kHalfSide_m, kHalfSide_m}) {
        nearest = std::min(nearest, 2 - (body.x + body.cos * x - body.sin * y));
      }
    }
    EXPECT_NEAR(gap_to(body, wall), nearest, 1e-15);
  }
}

}  // namespace
}  // namespace swarmsmith
