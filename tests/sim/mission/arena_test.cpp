#include "sim/mission/arena.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/mission/colors.h"

namespace swarmsmith {
namespace {

/// Distance of the origin from the wall's line.
double inradius(const Wall& wall) {
  const double dx = wall.to.x - wall.from.x;
  const double dy = wall.to.y - wall.from.y;
  return (wall.from.x * dy - wall.from.y * dx) / std::hypot(dx, dy);
}

double length(const Wall& wall) {
  return std::hypot(wall.to.x - wall.from.x, wall.to.y - wall.from.y);
}

/// Walls that end where the next one begins, and turn left.
void expect_closed_and_convex(const Arena& arena) {
  for (std::size_t i = 0; i < arena.walls.size(); ++i) {
    const Wall& wall = arena.walls[i];
    const Wall& next = arena.walls[(i + 1) % arena.walls.size()];
    EXPECT_NEAR(wall.to.x, next.from.x, 1e-12);
    EXPECT_NEAR(wall.to.y, next.from.y, 1e-12);
    EXPECT_GT((wall.to.x - wall.from.x) * (next.to.y - next.from.y) -
                  (wall.to.y - wall.from.y) * (next.to.x - next.from.x),
              0);
  }
}

TEST(Dodecagon, OfTheThesisHasItsInnerFacesAtTwoDistances) {
  const Arena arena = dodecagon_of_the_thesis();
  ASSERT_EQ(arena.walls.size(), 12U);
  expect_closed_and_convex(arena);
  for (std::size_t k = 0; k < arena.walls.size(); ++k) {
    EXPECT_NEAR(inradius(arena.walls[k]), k % 3 == 0 ? 1.226 : 1.22568, 4e-6) << k;
    EXPECT_NEAR(length(arena.walls[k]), 0.657, 1.5e-3) << k;
  }
  // 12 (2 - sqrt 3) r^2 with r between the two.
  EXPECT_NEAR(area_of(arena), 4.831, 0.001);
}

TEST(Dodecagon, ByAreaIsRegularAndHasThatArea) {
  const Arena arena = regular_dodecagon(4.91);
  ASSERT_EQ(arena.walls.size(), 12U);
  expect_closed_and_convex(arena);
  EXPECT_NEAR(area_of(arena), 4.91, 1e-12);
  for (const Wall& wall : arena.walls) {
    EXPECT_NEAR(inradius(wall), 1.2357, 5e-5);
    EXPECT_NEAR(length(wall), 0.6622, 5e-5);
  }
  EXPECT_NEAR(arena.walls[0].from.x, arena.walls[0].to.x, 1e-12);  // its middle on the x axis
}

TEST(Patch, ItsBorderBelongsToIt) {
  const Patch disc{Disc{{0, 0}, 0.5}, {0, 0, 0}};
  EXPECT_TRUE(color_at(disc, {0.5, 0}));
  EXPECT_TRUE(color_at(disc, {0.3, -0.4}));
  EXPECT_FALSE(color_at(disc, {0.5000001, 0}));
  const Patch box{Rectangle{{1, 1}, 0.5, 0.25}, {0, 0, 0}};
  EXPECT_TRUE(color_at(box, {1.25, 1.125}));
  EXPECT_TRUE(color_at(box, {0.75, 0.875}));
  EXPECT_FALSE(color_at(box, {1.2500001, 1}));
  EXPECT_FALSE(color_at(box, {1, 1.1250001}));
}

TEST(Floor, LaterPatchesLieOnTop) {
  Arena arena{.walls = {}, .patches = {}};
  EXPECT_EQ(floor_at(arena, {0, 0}), (Rgb{127, 127, 127}));
  arena.patches.push_back({Disc{{0, 0}, 1}, {0, 0, 0}});
  arena.patches.push_back({Disc{{0, 0}, 0.5}, {255, 0, 0}});
  EXPECT_EQ(floor_at(arena, {0, 0}), (Rgb{255, 0, 0}));
  EXPECT_EQ(floor_at(arena, {0.7, 0}), (Rgb{0, 0, 0}));
  EXPECT_EQ(floor_at(arena, {1.7, 0}), (Rgb{127, 127, 127}));
}

TEST(Colors, HaveNames) {
  EXPECT_EQ(color_from_name("yellow"), (Rgb{255, 255, 0}));
  EXPECT_EQ(color_from_name("gray"), (Rgb{127, 127, 127}));
  EXPECT_FALSE(color_from_name("Yellow").has_value());
  for (const NamedColor& named : kNamedColors)
    EXPECT_EQ(color_from_name(named.name), named.color);
}

}  // namespace
}  // namespace swarmsmith
