#include "analysis/statistics/multiple_tests.h"

#include <gtest/gtest.h>

namespace swarmsmith {
namespace {

using PValues = std::vector<std::optional<double>>;

TEST(Holm, MultipliesBySteppingDown) {
  EXPECT_EQ(holm_adjusted(PValues{0.5, 0.0625, 0.25}), (PValues{0.5, 0.1875, 0.5}));
}

TEST(Holm, NeverSaysMoreThanOneOrLessThanASmallerP) {
  EXPECT_EQ(holm_adjusted(PValues{0.75, 0.75}), (PValues{1.0, 1.0}));
  EXPECT_EQ(holm_adjusted(PValues{0.25, 0.375}), (PValues{0.5, 0.5}));
}

TEST(Holm, DoesNotCountTestsWithoutP) {
  EXPECT_EQ(holm_adjusted(PValues{0.25, std::nullopt}), (PValues{0.25, std::nullopt}));
}

}  // namespace
}  // namespace swarmsmith
