#include "analysis/statistics/effect_size.h"

#include <gtest/gtest.h>

#include <vector>

namespace swarmsmith {
namespace {

using Values = std::vector<double>;

TEST(VarghaDelaney, CountsPairsAndHalfTheTies) {
  EXPECT_EQ(vargha_delaney(Values{1, 2, 3}, Values{2, 2}), (0 + 1 + 2) / 6.0);
  EXPECT_EQ(vargha_delaney(Values{5, 6}, Values{1, 2, 3}), 1);
  EXPECT_EQ(vargha_delaney(Values{1}, Values{1}), 0.5);
}

TEST(VarghaDelaney, BoundsOfMagnitudesBelongToTheLarger) {
  EXPECT_EQ(magnitude_of(0.5), "negligible");
  EXPECT_EQ(magnitude_of(0.5599), "negligible");
  EXPECT_EQ(magnitude_of(0.56), "small");
  EXPECT_EQ(magnitude_of(0.64), "medium");
  EXPECT_EQ(magnitude_of(0.71), "large");
  EXPECT_EQ(magnitude_of(0.29), "large");
  EXPECT_EQ(magnitude_of(0.44), "small");
}

}  // namespace
}  // namespace swarmsmith
