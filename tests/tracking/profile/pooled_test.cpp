#include "tracking/profile/pooled.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/rng.h"

namespace swarmsmith {
namespace {

TEST(Pooled, OfOneIsThatOne) {
  const Pooled one = pooled(std::vector<Estimate>{{0.2, 0.01}});
  EXPECT_DOUBLE_EQ(one.mean, 0.2);
  EXPECT_NEAR(one.error, 0.01, 1e-12);
  EXPECT_EQ(one.spread, 0);
  EXPECT_NEAR(one.high - one.low, 2 * 1.96 * 0.01, 1e-4);
}

TEST(Pooled, IsDerSimonianAndLairds) {
  // By hand: weights 100 and 25, Q = 20 * 0.25 = 5, scale = 125 - 10625 / 125 = 40, so 0.1 between.
  const Pooled two = pooled(std::vector<Estimate>{{1.0, 0.1}, {1.5, 0.2}});
  EXPECT_NEAR(two.spread, std::sqrt(0.1), 1e-12);
  const double first = 1 / (0.01 + 0.1);
  const double second = 1 / (0.04 + 0.1);
  EXPECT_NEAR(two.mean, (first + 1.5 * second) / (first + second), 1e-12);
}

TEST(Pooled, ItsIntervalHoldsTheMeanNineteenTimesInTwenty) {
  Rng rng(7);
  for (const double spread : {0.0, 0.05}) {
    for (const int count : {2, 5, 12}) {
      int held = 0;
      constexpr int kTrials = 1000;
      for (int trial = 0; trial < kTrials; ++trial) {
        std::vector<Estimate> estimates;
        for (int i = 0; i < count; ++i) {
          const double error = rng.uniform(0.01, 0.04);
          estimates.push_back({rng.normal(rng.normal(0.9, spread), error), error});
        }
        const Pooled all = pooled(estimates);
        if (all.low <= 0.9 && 0.9 <= all.high) ++held;
      }
      EXPECT_GE(held, 0.93 * kTrials) << spread << ", " << count;
    }
  }
}

TEST(Grouped, NoiseMakesNoGroups) {
  Rng rng(3);
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<Estimate> rates;
    for (int i = 0; i < 9; ++i)
      rates.push_back({rng.normal(0.3, 0.04), 0.02});
    EXPECT_TRUE(grouped(rates).weak.empty());
  }
}

TEST(Grouped, OneRobotThatSeesLessIsAGroup) {
  const Groups groups = grouped({{0.05, 0.01}, {0.55, 0.02}, {0.06, 0.01}, {0.04, 0.01}});
  ASSERT_EQ(groups.weak.size(), 1U);
  EXPECT_EQ(groups.weak[0].value, 0.55);
  EXPECT_EQ(groups.usual.size(), 3U);
  EXPECT_TRUE(grouped({{0.05, 0.01}}).weak.empty());
  EXPECT_TRUE(grouped({}).weak.empty());
}

}  // namespace
}  // namespace swarmsmith
