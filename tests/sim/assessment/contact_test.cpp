#include "sim/assessment/internal/contact.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "base/math.h"

namespace swarmsmith::assessment {
namespace {

constexpr double kSide_m = 0.286;

Footprint square(const Pose& pose) {
  return {BoxOutline{kSide_m, kSide_m}, pose};
}

TEST(BodyGap, OfTwoAlignedSquaresIsTheDistanceLessTheSide) {
  EXPECT_NEAR(body_gap(square({0, 0, 0}), square({0.4, 0, 0})), 0.4 - kSide_m, 1e-12);
  EXPECT_NEAR(body_gap(square({0, 0, kPi / 2}), square({0.1, -0.5, 0})), 0.5 - kSide_m, 1e-12);
  EXPECT_NEAR(body_gap(square({0, 0, 0}), square({0.2, 0.1, 0})), 0.2 - kSide_m, 1e-12);
}

TEST(BodyGap, ATurnedSquareReachesFartherByItsCorner) {
  EXPECT_NEAR(body_gap(square({0, 0, 0}), square({0.4, 0, kPi / 4})),
              0.4 - kSide_m / 2 - kSide_m / std::sqrt(2.0), 1e-12);
}

TEST(BodyGap, OfDiscsIsWhatIsBetweenThem) {
  const CircleOutline disc{0.035};
  EXPECT_NEAR(body_gap({disc, {0, 0, 0}}, {disc, {0.3, 0.4, 2}}), 0.5 - 0.07, 1e-12);
  EXPECT_NEAR(body_gap({disc, {1, 1, 0}}, {disc, {1, 1.05, 0}}), -0.02, 1e-12);
}

TEST(BodyGap, OfTrianglesIsFromAFaceToACorner) {
  // A face looks back, at x = -0.1; a corner is ahead.
  const PolygonOutline triangle{{{0.2, 0}, {-0.1, 0.15}, {-0.1, -0.15}}};
  EXPECT_NEAR(body_gap({triangle, {0, 0, 0}}, {triangle, {0.5, 0, 0}}), 0.2, 1e-12);
  EXPECT_NEAR(body_gap({triangle, {0, 0, kPi}}, {triangle, {0.5, 0, 0}}), 0.3, 1e-12);
}

TEST(WallGap, IsFromTheFaceThatLooksIn) {
  const Wall wall{{1, -1}, {1, 1}};  // the arena is on its left
  EXPECT_NEAR(wall_gap({CircleOutline{0.17}, {0.5, 0.3, 1}}, wall), 0.33, 1e-12);
  EXPECT_NEAR(wall_gap(square({0.5, 0.3, 0}), wall), 0.5 - kSide_m / 2, 1e-12);
  EXPECT_NEAR(wall_gap(square({0.5, 0.3, kPi / 4}), wall), 0.5 - kSide_m / std::sqrt(2.0), 1e-12);
}

TEST(AnyContact, IsWithAWallOrARobotWithinTwoMillimetres) {
  const Arena arena = dodecagon_of_the_thesis();
  std::array<Pose, 2> robots = {{{0, 0, 0}, {kSide_m + 0.003, 0, 0}}};
  EXPECT_FALSE(any_contact(BoxOutline{kSide_m, kSide_m}, robots, arena));
  robots[1].x = kSide_m + 0.001;
  EXPECT_TRUE(any_contact(BoxOutline{kSide_m, kSide_m}, robots, arena));
  robots[1] = {1.226 - kSide_m / 2 - 0.003, 0, 0};
  EXPECT_FALSE(any_contact(BoxOutline{kSide_m, kSide_m}, robots, arena));
  robots[1].x += 0.002;
  EXPECT_TRUE(any_contact(BoxOutline{kSide_m, kSide_m}, robots, arena));
}

}  // namespace
}  // namespace swarmsmith::assessment
