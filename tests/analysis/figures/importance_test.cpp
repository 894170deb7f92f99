#include "analysis/figures/importance.h"

#include <gtest/gtest.h>

#include <cmath>

namespace swarmsmith {
namespace {

TEST(CandidateEffects, AreFreeOfThePairsThatSomeDidNotSee) {
  // Candidate 1 is better by 2 than candidate 2. Pair 2 is worth 10 more, and only 1 and 3 saw it.
  const auto score = [](std::int64_t candidate, std::int64_t pair) {
    constexpr double kCandidate[] = {0, 3, 1, 2};
    constexpr double kPair[] = {0, 5, 15};
    return ScoredPair{{candidate}, pair, kCandidate[candidate] + kPair[pair]};
  };
  const auto effects =
      candidate_effects({score(1, 1), score(2, 1), score(3, 1), score(1, 2), score(3, 2)});
  EXPECT_NEAR(effects.at({1}) - effects.at({2}), 2, 1e-6);
  EXPECT_NEAR(effects.at({1}) - effects.at({3}), 1, 1e-6);
}

TEST(EtaSquared, IsThePartBetweenTheGroups) {
  // Worked out by hand: means 2 and 6 of 1, 3 and 5, 7; 16 of 20.
  EXPECT_DOUBLE_EQ(eta_squared({0, 0, 1, 1}, {1, 3, 5, 7}), 0.8);
  EXPECT_EQ(eta_squared({0, 0, 1, 1}, {1, 1, 5, 5}), 1);
  EXPECT_EQ(eta_squared({0, 1, 0, 1}, {1, 1, 5, 5}), 0);
  EXPECT_EQ(eta_squared({0, 1}, {3, 3}), 0);
}

TEST(ImportanceOf, IsBeyondChanceOnlyWhereTheGroupsDecide) {
  std::vector<std::size_t> groups;
  std::vector<double> decided;
  std::vector<double> noise;
  Rng rng(7);
  for (std::size_t i = 0; i < 200; ++i) {
    groups.push_back(i % 4);
    noise.push_back(rng.normal());
    decided.push_back(noise.back() + static_cast<double>(i % 4));
  }
  const Importance of_decided = importance_of(groups, decided, Rng(1));
  const Importance of_noise = importance_of(groups, noise, Rng(1));
  EXPECT_GT(of_decided.eta_squared, 0.4);
  EXPECT_LT(of_decided.by_chance, 0.1);
  EXPECT_LT(of_noise.eta_squared, 0.1);
  // 3 of 199 degrees of freedom: chi-squared says 7.81 / 199 for the 95th percentile.
  EXPECT_NEAR(of_noise.by_chance, 7.81 / 199, 0.02);
  EXPECT_EQ(importance_of(groups, noise, Rng(1)).by_chance, of_noise.by_chance);
}

}  // namespace
}  // namespace swarmsmith
