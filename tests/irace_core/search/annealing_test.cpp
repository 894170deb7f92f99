#include "irace_core/search/annealing.h"

#include <gmock/gmock.h>
#include <cmath>
#include <map>
#include <set>

#include "tests/irace_core/search/played.h"
#include "tests/support/not_empty.h"

namespace swarmsmith {
namespace {

SearchOptions annealing(double temperature = 1) {
  SearchOptions options = options_of(SearchKind::Annealing);
  std::get<AnnealingOptions>(options).start_temperature = temperature;
  return options;
}

TEST(Annealing, RunsThePerturbedOnTheWindowAndTheOthersOnItsNewPairs) {
  auto search = started(weights_space(3), annealing(), 3000);
  const Played played = play(*search, noisy_sphere);
  std::set<std::int64_t> known;
  std::int64_t window_end = 10;
  const std::int64_t last = search->iteration();
  for (const RaceStep& step : not_empty(only<RaceStep>(played.events))) {
    if (step.iteration == 1) continue;  // the scale
    if (step.iteration == last) break;  // the final stage
    window_end = step.pair;
    std::map<std::int64_t, int> runs;
    for (const auto& [configuration, pair] : step.evaluated) {
      ++runs[configuration];
      EXPECT_GT(pair, window_end - 10);
      EXPECT_LE(pair, window_end);
    }
    std::vector<int> counts;
    for (const auto& [configuration, count] : runs)
      counts.push_back(count);
    std::ranges::sort(counts);
    // The candidate; the incumbent and, when it is another one, the best.
    EXPECT_THAT(counts,
                ::testing::AnyOf(::testing::ElementsAre(1, 10), ::testing::ElementsAre(1, 1, 10)));
  }
}

TEST(Annealing, AtZeroNeverAcceptsWhatIsWorse) {
  // Without noise the incumbents' costs can only fall.
  auto search = started(weights_space(3), annealing(0), 6000);
  const Played played = play(*search, [](const Configuration& c, const Experiment&) {
    return c[0] * c[0] + c[1] * c[1] + c[2] * c[2];
  });
  double before = 1e9;
  for (const IterationEnded& ended : only<IterationEnded>(played.events)) {
    EXPECT_EQ(ended.elites.size(), 1U);  // the incumbent is the best
    EXPECT_LE(ended.elites.front().mean, before + 1e-12);
    before = ended.elites.front().mean;
  }
  EXPECT_LT(before, 0.1);
}

/// How many candidates were made from the one just before them, of all that have a parent.
std::pair<std::int64_t, std::int64_t> walked_of_steps(const Played& played) {
  std::int64_t walked = 0;
  std::int64_t steps = 0;
  for (const ConfigurationSampled& sampled : only<ConfigurationSampled>(played.events)) {
    if (sampled.parent == 0) continue;
    ++steps;
    walked += sampled.parent == sampled.id - 1 ? 1 : 0;
  }
  return {walked, steps};
}

TEST(Annealing, AtZeroAcceptsWhatIsEqual) {
  const auto level = [](const Configuration&, const Experiment&) { return 1.0; };
  const auto [walked, steps] =
      walked_of_steps(play(*started(weights_space(3), annealing(0), 4000), level));
  EXPECT_GT(steps, 100);
  EXPECT_GT(walked, steps * 95 / 100);
}

TEST(Annealing, WarmAcceptsWhatIsWorseAndColdDoesNot) {
  const auto at = [](double temperature) {
    SearchOptions options = annealing(temperature);
    std::get<AnnealingOptions>(options).end_temperature = temperature;
    const auto cost = [](const Configuration& c, const Experiment&) { return 1 + std::fabs(c[0]); };
    return walked_of_steps(play(*started(weights_space(1), options, 4000), cost));
  };
  // A random walk: the parent of nearly every candidate is the one before it.
  const auto [walked, steps] = at(1e6);
  EXPECT_GT(steps, 0);
  EXPECT_GT(walked, steps * 95 / 100);
  EXPECT_LT(at(1e-6).first, steps / 2);
}

TEST(Annealing, CountsTemperaturesInStandardDeviations) {
  // Costs a thousand times as large lead to the same decisions.
  const auto cost = [](double scale) {
    return
        [scale](const Configuration& c, const Experiment& e) { return scale * noisy_sphere(c, e); };
  };
  const Played small = play(*started(weights_space(3), annealing(), 4000), cost(1));
  const Played large = play(*started(weights_space(3), annealing(), 4000), cost(1024));
  const auto few = only<ConfigurationSampled>(small.events);
  const auto many = only<ConfigurationSampled>(large.events);
  ASSERT_EQ(few.size(), many.size());
  for (std::size_t i = 0; i < few.size(); ++i)
    EXPECT_EQ(few[i].parent, many[i].parent);
}

/// The smallest machine, which is not random, may cost far more than they do.
TEST(Annealing, TakesItsScaleFromRandomConfigurationsAlone) {
  const Configuration smallest =
      only<ConfigurationSampled>(
          play(*started(weights_space(1), annealing(), 1000), noisy_sphere).events)
          .front()
          .configuration;
  const auto cost = [&](const Configuration& c, const Experiment&) {
    return c == smallest ? 1e6 : 1 + std::fabs(c[0]);
  };
  for (const bool at_random : {false, true}) {
    SearchOptions options = annealing(1e-3);
    std::get<AnnealingOptions>(options).end_temperature = 1e-3;
    std::get<AnnealingOptions>(options).start_at_random = at_random;
    const auto [walked, steps] =
        walked_of_steps(play(*started(weights_space(1), options, 4000), cost));
    EXPECT_LT(walked, steps * 3 / 4) << at_random;
  }
}

TEST(Annealing, CannotBeExtendedAndSaysWhy) {
  auto search = started(weights_space(3), annealing(), 1000);
  play(*search, noisy_sphere);
  EXPECT_THAT(search->least_extension().error().message, ::testing::HasSubstr("temperatures"));
}

TEST(OneParameterNeighbourhood, ChangesOneAndKeepsTheSpace) {
  const ParameterSpace space = mixed_space();
  Rng rng(4);
  Configuration now = sample_uniform(space, rng).value();
  const search::Neighbourhood neighbourhood = search::one_parameter_neighbourhood(space, now);
  std::set<double> modes;
  for (int i = 0; i < 10'000; ++i) {
    const Configuration next = neighbourhood.perturb(now, rng).value();
    ASSERT_TRUE(space.check(next));
    EXPECT_FALSE(next == now);
    const int changed = (next[0] != now[0]) + (next[2] != now[2]) +
                        (next[0] == now[0] && next.is_active(1) && next[1] != now[1]);
    EXPECT_EQ(changed, 1);
    now = next;
    modes.insert(now[0]);
  }
  EXPECT_EQ(modes.size(), 3U);
}

TEST(OneParameterNeighbourhood, SaysWhenThereIsNothingElse) {
  const auto is_b =
      Expression::call(Operation::Equal, {Expression::parameter("mode"), Expression::text("b")});
  const ParameterSpace space =
      ParameterSpace::make({{"mode", "--mode ", Categorical{{"a", "b"}}, {}}}, {is_b}, 2).value();
  Configuration now(1);
  now.set(0, 0);
  Rng rng(4);
  const auto other = search::one_parameter_neighbourhood(space, now).perturb(now, rng);
  ASSERT_FALSE(other);
  EXPECT_THAT(other.error().message, ::testing::HasSubstr("besides the incumbent"));
}

}  // namespace
}  // namespace swarmsmith
