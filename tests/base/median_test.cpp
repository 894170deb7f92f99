#include "base/median.h"

#include <gtest/gtest.h>

namespace swarmsmith {
namespace {

TEST(Median, IsTheMiddleByWhateverOrder) {
  EXPECT_EQ(median_of({3}), 3);
  EXPECT_EQ(median_of({9, 1, 5}), 5);
  EXPECT_EQ(upper_median({9, 1, 5}), 5);
}

TEST(Median, OfAnEvenNumberIsTheMeanOfTwoOrTheUpperOne) {
  EXPECT_EQ(median_of({4, 1, 8, 2}), 3);
  EXPECT_EQ(upper_median({4, 1, 8, 2}), 4);
  EXPECT_EQ(median_of({2, 2}), 2);
}

TEST(MedianDeathTest, OfNothingIsNone) {
  EXPECT_DEATH(upper_median({}), "a median needs a value");
}

}  // namespace
}  // namespace swarmsmith
