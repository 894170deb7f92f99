#include "base/rng.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>
#include <vector>

namespace swarmsmith {
namespace {

TEST(Rng, SameSeedGivesSameNumbers) {
  Rng a(7);
  Rng b(7);
  for (int i = 0; i < 100; ++i)
    EXPECT_EQ(a.next(), b.next());
  EXPECT_NE(Rng(7).next(), Rng(8).next());
}

TEST(Rng, SplitDependsOnNameAndIndexButNotOnDraws) {
  Rng a(7);
  Rng b(7);
  b.next();
  EXPECT_EQ(a.split("race", 3).next(), b.split("race", 3).next());
  EXPECT_NE(a.split("race", 3).next(), a.split("race", 4).next());
  EXPECT_NE(a.split("race", 3).next(), a.split("model", 3).next());
}

TEST(Rng, NumbersAreFixed) {
  // A change here changes every campaign that was ever recorded.
  EXPECT_EQ(Rng(1).next(), 6791897765849424158U);
  EXPECT_EQ(Rng(1).split("race", 3).next(), 12567489922471082947U);
}

TEST(Rng, IntegersAreUniform) {
  Rng rng(11);
  std::array<int, 7> counts{};
  for (int i = 0; i < 70'000; ++i)
    ++counts[rng.below(7)];
  double chi_square = 0;
  for (const int count : counts)
    chi_square += (count - 10'000.0) * (count - 10'000.0) / 10'000.0;
  EXPECT_LT(chi_square, 22.46);  // 0.1 % point of 6 degrees of freedom
  for (int i = 0; i < 1000; ++i) {
    const auto x = rng.uniform_int(-2, 3);
    EXPECT_GE(x, -2);
    EXPECT_LE(x, 3);
  }
}

TEST(Rng, NormalsHaveTheirMoments) {
  Rng rng(12);
  double sum = 0;
  double squares = 0;
  const int n = 400'000;
  for (int i = 0; i < n; ++i) {
    const double x = rng.normal();
    sum += x;
    squares += x * x;
  }
  EXPECT_NEAR(sum / n, 0, 4 / std::sqrt(n));
  EXPECT_NEAR(squares / n, 1, 4 * std::sqrt(2.0 / n));
}

TEST(Rng, ShuffleReachesEveryOrderEquallyOften) {
  Rng rng(13);
  std::array<int, 6> counts{};
  for (int i = 0; i < 60'000; ++i) {
    std::array<int, 3> items{0, 1, 2};
    rng.shuffle(std::span<int>(items));
    ++counts[static_cast<std::size_t>(items[0] * 2 + (items[1] > items[2] ? 1 : 0))];
  }
  for (const int count : counts)
    EXPECT_NEAR(count, 10'000, 400);
}

TEST(Rng, BernoulliHasItsEnds) {
  Rng rng(14);
  for (int i = 0; i < 1000; ++i) {
    EXPECT_FALSE(rng.bernoulli(0));
    EXPECT_TRUE(rng.bernoulli(1));
  }
}

}  // namespace
}  // namespace swarmsmith
