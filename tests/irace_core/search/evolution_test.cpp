#include "irace_core/search/evolution.h"

#include <gmock/gmock.h>
#include <cmath>

#include "tests/irace_core/search/played.h"
#include "tests/support/not_empty.h"

namespace swarmsmith {
namespace {

/// Pearson's statistic of counts against their expected shares.
double chi_squared(std::span<const double> counts, std::span<const double> shares) {
  double all = 0;
  for (const double count : counts)
    all += count;
  double sum = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double expected = all * shares[i];
    sum += (counts[i] - expected) * (counts[i] - expected) / expected;
  }
  return sum;
}

/// 20 weights of 3: what becomes of the first and of the last ones in 100,000 mutations.
TEST(NeatMutation, HasThePublishedShares) {
  constexpr double kOld = 3;
  Rng rng(1);
  // Kept, replaced, added to; weight 0 and the last weight.
  std::array<std::array<double, 3>, 2> counts{};
  for (int i = 0; i < 100'000; ++i) {
    std::vector<double> weights(20, kOld);
    search::mutate(weights, Mutation::Neat, 1, rng);
    for (const std::size_t end : {std::size_t{0}, std::size_t{1}}) {
      const double weight = end == 0 ? weights.front() : weights.back();
      EXPECT_TRUE(std::abs(weight) < 1 || std::abs(weight - kOld) < 1);
      ++counts[end][weight == kOld ? 0 : std::abs(weight) < 1 ? 1 : 2];
    }
  }
  // Half of all mutations are severe: 10 %, 20 %, 70 %. The others add to each weight, but for the
  // last fifth: 30 %, 20 %, 50 %. 13.8 is the quantile of 0.999 with two degrees of freedom.
  EXPECT_LT(chi_squared(counts[0], std::array{0.05, 0.10, 0.85}), 13.8);
  EXPECT_LT(chi_squared(counts[1], std::array{0.20, 0.20, 0.60}), 13.8);
}

TEST(NeatMutation, LastFifthBeginsBehindFourFifths) {
  // 26 weights: those from index 21 on can stay as they are in a mutation that is not severe.
  Rng rng(2);
  std::array<int, 26> kept{};
  for (int i = 0; i < 20'000; ++i) {
    std::vector<double> weights(26, 3);
    search::mutate(weights, Mutation::Neat, 1, rng);
    for (std::size_t k = 0; k < weights.size(); ++k)
      kept[k] += weights[k] == 3 ? 1 : 0;
  }
  for (std::size_t k = 0; k < kept.size(); ++k)
    EXPECT_EQ(kept[k] > 2500, k >= 21) << k << ": " << kept[k];
}

TEST(Mutation, StaysInTheBox) {
  Rng rng(3);
  for (const Mutation kind : {Mutation::Neat, Mutation::Normal}) {
    std::vector<double> weights(10, 4.9);
    for (int i = 0; i < 1000; ++i) {
      search::mutate(weights, kind, 3, rng);
      EXPECT_THAT(weights, ::testing::Each(::testing::AllOf(::testing::Ge(-5), ::testing::Le(5))));
    }
  }
}

TEST(Evolution, KeepsItsBestFifthAndRunsThemAgain) {
  auto search = started(weights_space(6), options_of(SearchKind::Evolution), 10'000);
  const Played played = play(*search, noisy_sphere);
  const auto starts = only<IterationStarted>(played.events);
  const auto ends = only<IterationEnded>(played.events);
  ASSERT_EQ(starts.size(), 9U);
  for (std::size_t i = 0; i < starts.size(); ++i) {
    EXPECT_EQ(starts[i].n_configurations, 100);
    EXPECT_EQ(starts[i].new_pairs, i < 8 ? 10 : 20);
    EXPECT_EQ(starts[i].postselection, i == 8);
    EXPECT_EQ(starts[i].model_digest == 0, i == 0);
    if (i == 0) continue;
    ASSERT_EQ(ends[i - 1].elites.size(), 20U);
    for (std::size_t k = 0; k < 20; ++k)
      EXPECT_EQ(starts[i].elites[k], ends[i - 1].elites[k].configuration);
  }
  // 100 at first, 80 new ones in each of seven generations and in the final stage.
  EXPECT_EQ(only<ConfigurationSampled>(played.events).size(), 100U + 8 * 80);
  // Judged by the new pairs alone.
  for (const IterationEnded& ended : ends)
    EXPECT_EQ(ended.elites.front().n, &ended == &ends.back() ? 20 : 10);
  EXPECT_EQ(played.elites.size(), 100U);
}

TEST(Evolution, DrawsParentsEvenlyFromTheElites) {
  auto search = started(weights_space(6), options_of(SearchKind::Evolution), 100'000);
  const Played played = play(*search, noisy_sphere);
  const auto ends = only<IterationEnded>(played.events);
  std::vector<double> counts(20, 0);
  for (const ConfigurationSampled& sampled : only<ConfigurationSampled>(played.events)) {
    if (sampled.parent == 0) continue;
    const auto& elites = ends[static_cast<std::size_t>(sampled.iteration) - 2].elites;
    const auto rank = std::ranges::find(elites, sampled.parent, &Elite::configuration);
    ASSERT_NE(rank, elites.end());
    if (sampled.iteration <= 90) ++counts[static_cast<std::size_t>(rank - elites.begin())];
  }
  // The quantile of 0.999 with 19 degrees of freedom.
  EXPECT_LT(chi_squared(counts, std::vector<double>(20, 0.05)), 43.8);
}

TEST(Evolution, GoesOnWithWhatWasRun) {
  // Two decimals: every child differs from a configuration of the generation before by what a
  // mutation of rounded weights gives, and is a point of the space.
  auto search = started(weights_space(3, 2), options_of(SearchKind::Evolution), 4000);
  const Played played = play(*search, noisy_sphere);
  for (const ConfigurationSampled& sampled : not_empty(only<ConfigurationSampled>(played.events)))
    EXPECT_TRUE(search->space().check(sampled.configuration));
}

}  // namespace
}  // namespace swarmsmith
