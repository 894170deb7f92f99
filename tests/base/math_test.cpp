#include "base/math.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/rng.h"

namespace swarmsmith {
namespace {

/// Distance from `value` to `truth` in units of the last place of `truth` as a double.
double ulps(double value, long double truth) {
  const double near = static_cast<double>(truth);
  const double ulp = std::nextafter(std::fabs(near), INFINITY) - std::fabs(near);
  return static_cast<double>(std::fabs(static_cast<long double>(value) - truth) / ulp);
}

TEST(Math, SineAndCosineAreWithinThreeUlpsOfTheWideOnes) {
  Rng rng(1);
  for (int i = 0; i < 200'000; ++i) {
    const double x = rng.uniform(-10, 10);
    const SinCos got = sin_cos(x);
    ASSERT_LT(ulps(got.sin, std::sin(static_cast<long double>(x))), 3) << x;
    ASSERT_LT(ulps(got.cos, std::cos(static_cast<long double>(x))), 3) << x;
  }
}

TEST(Math, ArcTangentIsWithinThreeUlpsInAllQuadrants) {
  Rng rng(2);
  for (int i = 0; i < 200'000; ++i) {
    const double x = rng.uniform(-3, 3);
    const double y = rng.uniform(-3, 3);
    ASSERT_LT(ulps(atan2(y, x), std::atan2(static_cast<long double>(y), x)), 3) << y << " " << x;
  }
  EXPECT_EQ(atan2(0, 1), 0);
  EXPECT_EQ(atan2(0, -1), kPi);
  EXPECT_EQ(atan2(1, 0), kPi / 2);
  EXPECT_EQ(atan2(-1, 0), -kPi / 2);
  EXPECT_EQ(atan2(0, 0), 0);
}

TEST(Math, ExponentialAndLogarithmAreWithinThreeUlps) {
  Rng rng(3);
  for (int i = 0; i < 200'000; ++i) {
    const double x = rng.uniform(-700, 700);
    ASSERT_LT(ulps(exp(x), std::exp(static_cast<long double>(x))), 3) << x;
    const double y = exp(rng.uniform(-300, 300));
    ASSERT_LT(ulps(log(y), std::log(static_cast<long double>(y))), 3) << y;
    const double near_one = rng.uniform(0.5, 2);
    ASSERT_LT(ulps(log(near_one), std::log(static_cast<long double>(near_one))), 3) << near_one;
  }
}

TEST(Math, ExponentialAndLogarithmHaveTheirLimits) {
  EXPECT_EQ(exp(0), 1);
  EXPECT_EQ(exp(800), INFINITY);
  EXPECT_EQ(exp(-800), 0);
  EXPECT_EQ(log(1), 0);
  EXPECT_EQ(log(0), -INFINITY);
  EXPECT_TRUE(std::isnan(log(-1)));
  EXPECT_DOUBLE_EQ(log(std::numeric_limits<double>::denorm_min()),
                   std::log(std::numeric_limits<double>::denorm_min()));
}

TEST(Math, NormalDistributionAgreesWithTheErrorFunctionAndItsInverse) {
  for (double x = -8; x <= 8; x += 0.01) {
    const double truth = 0.5 * std::erfc(-x / std::sqrt(2.0));
    EXPECT_NEAR(normal_cdf(x) / truth, 1, 2e-13) << x;
    if (std::fabs(x) < 5) {
      EXPECT_NEAR(normal_quantile(normal_cdf(x)), x, 1e-9) << x;
    }
  }
  EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-15);
  EXPECT_NEAR(normal_quantile(1e-10), -6.361340902404056, 1e-14);
}

TEST(Math, AnglesWrapIntoTheHalfOpenInterval) {
  EXPECT_EQ(wrap_angle(kPi), kPi);
  EXPECT_EQ(wrap_angle(-kPi), kPi);
  EXPECT_NEAR(wrap_angle(7), 7 - 2 * kPi, 1e-15);
  EXPECT_NEAR(wrap_angle(-100), -100 + 32 * kPi, 1e-13);
  for (int turns = -159; turns < 159; ++turns) {
    double angle = (2 * turns + 1) * kPi - 1e-12;
    for (const double end = angle + 2e-12; angle <= end; angle = std::nextafter(angle, INFINITY)) {
      ASSERT_GT(wrap_angle(angle), -kPi) << turns;
      ASSERT_LE(wrap_angle(angle), kPi) << turns;
    }
  }
}

TEST(Math, PowerAgreesWithTheLibrary) {
  for (const double base : {0.001, 0.2, 0.9, 1.0, 3.0, 117.0}) {
    for (const double exponent : {-3.0, 1.0 / 149, 0.5, 2.0}) {
      EXPECT_NEAR(pow(base, exponent) / std::pow(base, exponent), 1, 1e-14);
    }
  }
}

TEST(Math, BitsAreFixed) {
  // The same on every machine and compiler; a change here changes every recorded campaign.
  std::uint64_t sum = 0;
  Rng rng(4);
  for (int i = 0; i < 10'000; ++i) {
    const double x = rng.uniform(-6, 6);
    for (const double value : {sin(x), cos(x), atan2(x, 1.3), exp(x), log(x + 6.5), rng.normal()}) {
      sum = mix64(sum ^ std::bit_cast<std::uint64_t>(value));
    }
  }
  EXPECT_EQ(sum, 327743018813274742U);
}

}  // namespace
}  // namespace swarmsmith
