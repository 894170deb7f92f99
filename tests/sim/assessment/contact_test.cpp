#include "sim/assessment/internal/contact.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "base/math.h"

namespace swarmsmith::assessment {
namespace {

constexpr double kSide_m = 0.286;

TEST(BodyGap, OfTwoAlignedSquaresIsTheDistanceLessTheSide) {
  EXPECT_NEAR(body_gap({0, 0, 0}, {0.4, 0, 0}), 0.4 - kSide_m, 1e-12);
  EXPECT_NEAR(body_gap({0, 0, kPi / 2}, {0.1, -0.5, 0}), 0.5 - kSide_m, 1e-12);
  EXPECT_NEAR(body_gap({0, 0, 0}, {0.2, 0.1, 0}), 0.2 - kSide_m, 1e-12);
}

TEST(BodyGap, ATurnedSquareReachesFartherByItsCorner) {
  EXPECT_NEAR(body_gap({0, 0, 0}, {0.4, 0, kPi / 4}), 0.4 - kSide_m / 2 - kSide_m / std::sqrt(2.0),
              1e-12);
}

TEST(WallGap, IsFromTheFaceThatLooksIn) {
  const Wall wall{{1, -1}, {1, 1}};  // the arena is on its left
  EXPECT_NEAR(wall_gap({0.5, 0.3, 0}, wall), 0.5 - kSide_m / 2, 1e-12);
  EXPECT_NEAR(wall_gap({0.5, 0.3, kPi / 4}, wall), 0.5 - kSide_m / std::sqrt(2.0), 1e-12);
}

TEST(AnyContact, IsWithAWallOrARobotWithinTwoMillimetres) {
  const Arena arena = dodecagon_of_the_thesis();
  std::array<Pose, 2> robots = {{{0, 0, 0}, {kSide_m + 0.003, 0, 0}}};
  EXPECT_FALSE(any_contact(robots, arena));
  robots[1].x = kSide_m + 0.001;
  EXPECT_TRUE(any_contact(robots, arena));
  robots[1] = {1.226 - kSide_m / 2 - 0.003, 0, 0};
  EXPECT_FALSE(any_contact(robots, arena));
  robots[1].x += 0.002;
  EXPECT_TRUE(any_contact(robots, arena));
}

}  // namespace
}  // namespace swarmsmith::assessment
