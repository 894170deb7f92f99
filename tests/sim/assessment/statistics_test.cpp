#include "sim/assessment/internal/statistics.h"

#include <gtest/gtest.h>

#include <vector>

namespace swarmsmith::assessment {
namespace {

// By hand for 3 of 10, with z = 2.5758 and z^2 = 6.6349: centre (0.3 + 0.331745) / 1.66349 =
// 0.379771, half-width 2.5758 sqrt(0.021 + 0.01658724) / 1.66349 = 0.300204.
TEST(WilsonInterval, IsTheFormula) {
  const Interval interval = wilson_interval(3, 10);
  EXPECT_NEAR(interval.low, 0.079567, 1e-5);
  EXPECT_NEAR(interval.high, 0.679975, 1e-5);
}

TEST(WilsonInterval, KnowsNothingWithoutATrialAndStaysWithinZeroAndOne) {
  EXPECT_EQ(wilson_interval(0, 0).low, 0);
  EXPECT_EQ(wilson_interval(0, 0).high, 1);
  EXPECT_EQ(wilson_interval(0, 5).low, 0);
  EXPECT_EQ(wilson_interval(5, 5).high, 1);
}

TEST(GeometricChiSquare, IsZeroForTheLawItself) {
  EXPECT_DOUBLE_EQ(geometric_chi_square(std::vector<double>{1, 1, 1, 1, 2, 2, 3, 9}), 0);
}

// Of 16: expected 8, 4, 2, 2; found 16, 0, 0, 0: 8 + 4 + 2 + 2.
TEST(GeometricChiSquare, IsWorkedOutByHand) {
  EXPECT_DOUBLE_EQ(geometric_chi_square(std::vector<double>(16, 1)), 16);
  EXPECT_GT(geometric_chi_square(std::vector<double>(16, 1)), kChiSquare3At1Percent);
}

}  // namespace
}  // namespace swarmsmith::assessment
