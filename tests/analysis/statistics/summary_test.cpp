#include "analysis/statistics/summary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace swarmsmith {
namespace {

TEST(Summary, OfFourValues) {
  const std::vector<double> values = {4, 1, 3, 2};
  const Summary summary = summary_of(values);
  EXPECT_EQ(summary.n, 4U);
  EXPECT_EQ(summary.mean, 2.5);
  EXPECT_DOUBLE_EQ(summary.sd, std::sqrt(5.0 / 3));
  EXPECT_EQ(summary.least, 1);
  EXPECT_EQ(summary.lower_quartile, 1.75);
  EXPECT_EQ(summary.median, 2.5);
  EXPECT_EQ(summary.upper_quartile, 3.25);
  EXPECT_EQ(summary.most, 4);
  EXPECT_EQ(quantile_of(std::vector<double>{1, HUGE_VAL}, 0), 1);
}

TEST(Summary, OfOneValueHasNoSpread) {
  const Summary summary = summary_of(std::vector<double>{7});
  EXPECT_EQ(summary.median, 7);
  EXPECT_EQ(summary.upper_quartile, 7);
  EXPECT_TRUE(std::isnan(summary.sd));
}

TEST(Summary, OfNothingIsNothing) {
  const Summary summary = summary_of({});
  EXPECT_EQ(summary.n, 0U);
  EXPECT_TRUE(std::isnan(summary.mean));
}

TEST(Summary, TheMeanDoesNotDependOnTheOrder) {
  std::vector<double> values;
  for (int i = 0; i < 1000; ++i)
    values.push_back(0.1 * i);
  const double up = mean_of(values);
  const std::vector<double> down(values.rbegin(), values.rend());
  EXPECT_EQ(up, mean_of(down));
  EXPECT_EQ(mean_of(std::vector<double>(7, 0.1)), 0.1);
}

TEST(Summary, TheMeanIsExactWhereOneSumIsNot) {
  // After 2^64, a long double of 64 bits loses each 1. The mean is 2^52 + 4095 / 4096.
  std::vector<double> values(4096, 1);
  values.front() = std::exp2(64);
  EXPECT_EQ(mean_of(values), std::exp2(52) + 1);
  EXPECT_EQ(mean_of(std::vector<double>{1e-30}), 1e-30);
}

TEST(MeanInterval, IsStudents) {
  const MeanInterval summary = mean_interval(std::vector<double>{1, 2, 3, 4, 5});
  EXPECT_DOUBLE_EQ(summary.mean, 3);
  // R: t.test(1:5)$conf.int is 1.036757 to 4.963243.
  EXPECT_NEAR(summary.half_width, 1.963243, 1e-6);
  // R: t.test(c(1, 2))$conf.int is -4.853102 to 7.853102.
  EXPECT_NEAR(mean_interval(std::vector<double>{1, 2}).half_width, 6.353102, 1e-6);
  EXPECT_EQ(mean_interval(std::vector<double>{7}).half_width, 0);
}

}  // namespace
}  // namespace swarmsmith
