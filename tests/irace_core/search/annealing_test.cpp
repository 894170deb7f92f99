#include "irace_core/search/annealing.h"

#include <gmock/gmock.h>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "tests/irace_core/search/played.h"
#include "tests/support/checks.h"
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

/// Of the random configurations two are not rejected: their costs differ, so that it walks.
TEST(Annealing, TakesItsScaleFromTwoConfigurationsAndNotFromOne) {
  const auto walked_with = [](std::int64_t last) {
    const auto cost = [last](const Configuration& c, const Experiment& experiment) {
      const bool is_rejected = experiment.configuration > last && experiment.configuration <= 21;
      return is_rejected ? std::numeric_limits<double>::infinity() : 1 + std::fabs(c[0]);
    };
    SearchOptions options = annealing(1e6);
    std::get<AnnealingOptions>(options).end_temperature = 1e6;
    return walked_of_steps(play(*started(weights_space(1), options, 4000), cost));
  };
  const auto [two, steps] = walked_with(3);
  EXPECT_GT(two, steps * 95 / 100);
  const auto [one, as_many] = walked_with(2);
  EXPECT_LT(one, as_many / 2);
}

TEST(Annealing, CannotBeExtendedAndSaysWhy) {
  auto search = started(weights_space(3), annealing(), 1000);
  play(*search, noisy_sphere);
  const std::string why =
      "annealing cannot be extended: its temperatures follow from the whole budget. Run the "
      "campaign with the larger budget into a new store";
  EXPECT_EQ(to_string(search->least_extension().error()), why);
  EXPECT_EQ(to_string(search->extend(1000).error()), why);
}

/// The start and twenty others on a window of 10, an iteration, and 100 runs each of two at the
/// end.
TEST(Annealing, NeedsItsScaleAnIterationAndAFinalStage) {
  Scenario scenario;
  scenario.max_experiments = 21 * 10 + (10 + 2 * 1) + 2 * 100;
  EXPECT_TRUE(start_search(weights_space(3), scenario, annealing()));
  --scenario.max_experiments;
  EXPECT_EQ(complaint_of(start_search(weights_space(3), scenario, annealing())),
            "max_experiments: a budget of 421 experiments is too small: with these settings it "
            "must be at least 422");
}

TEST(Annealing, SaysWhichOptionsDoNotGoTogether) {
  const auto faults = [](void (*change)(AnnealingOptions&)) {
    AnnealingOptions options;
    change(options);
    std::string text;
    for (const SearchFault& fault : options.faults()) {
      for (const std::string_view key : fault.keys)
        text += std::string(key) + " ";
      text += "- " + fault.message + "; ";
    }
    return text;
  };
  EXPECT_EQ(faults([](AnnealingOptions&) {}), "");
  EXPECT_EQ(faults([](AnnealingOptions& o) { o.moved = o.window; }), "");
  EXPECT_EQ(faults([](AnnealingOptions& o) { o.moved = o.window + 1; }),
            "moved - `moved` must be at most `window`: a window moves on by parts of it; ");
  EXPECT_EQ(faults([](AnnealingOptions& o) { o.end_temperature = o.start_temperature; }), "");
  EXPECT_EQ(faults([](AnnealingOptions& o) { o.start_temperature = 0, o.end_temperature = 2; }),
            "");
  EXPECT_EQ(faults([](AnnealingOptions& o) { o.start_temperature = 0.5, o.end_temperature = 2; }),
            "end_temperature start_temperature - `end_temperature` (2) must be at most "
            "`start_temperature` (0.5): annealing cools; ");
  EXPECT_EQ(faults([](AnnealingOptions& o) { o.cooling = Cooling::Published; }), "");
  const std::string published =
      " is for geometric cooling; the published one begins at 125 score units, and again whenever "
      "it is below 0.00125; ";
  EXPECT_EQ(faults([](AnnealingOptions& o) {
              o.cooling = Cooling::Published, o.start_temperature = 2, o.end_temperature = 1;
            }),
            "start_temperature - `start_temperature`" + published +
                "end_temperature - `end_temperature`" + published);
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
  EXPECT_EQ(to_string(other.error()), "no configuration besides the incumbent is allowed");
}

/// `near` lies within 2 of `n`: a value of it that is outside after a change of `n` is drawn anew.
TEST(OneParameterNeighbourhood, KeepsValuesInDomainsThatMove) {
  const auto beside = [](double by) {
    return Expression::call(Operation::Add, {Expression::parameter("n"), Expression::number(by)});
  };
  const ParameterSpace space =
      ParameterSpace::make({{"n", "", Integer{0.0, 20.0}, {}},
                            {"near", "", Integer{beside(-2), beside(2)}, {}},
                            {"only", "", Categorical{{"one"}}, {}}},
                           {}, 2)
          .value();
  Rng rng(4);
  Configuration now = sample_uniform(space, rng).value();
  const search::Neighbourhood neighbourhood = search::one_parameter_neighbourhood(space, now);
  int kept = 0;
  int drawn = 0;
  for (int i = 0; i < 3000; ++i) {
    const Configuration next = neighbourhood.perturb(now, rng).value();
    ASSERT_TRUE(space.check(next));
    const bool fits = std::fabs(now[1] - next[0]) <= 2;
    if (next[0] != now[0] && fits) {
      EXPECT_EQ(next[1], now[1]);
    }
    kept += next[0] != now[0] && fits ? 1 : 0;
    drawn += next[0] != now[0] && !fits ? 1 : 0;
    now = next;
  }
  EXPECT_GT(kept, 100);
  EXPECT_GT(drawn, 100);
}

/// The upper bound of `m` is below its lower one for small values of `n`.
TEST(Annealing, SaysWhichDomainIsEmpty) {
  const auto space_up_to = [](double most) {
    return ParameterSpace::make({{"n", "", Integer{1.0, most}, {}},
                                 {"m", "", Integer{4.0, Expression::parameter("n")}, {}}},
                                {}, 2)
        .value();
  };
  Scenario scenario;
  scenario.max_experiments = 1000;
  EXPECT_EQ(why_not(start_search(space_up_to(3), scenario, annealing())).where, "m");
  const ParameterSpace space = space_up_to(9);
  Configuration valid(2);
  valid.set(0, 9);
  valid.set(1, 4);
  EXPECT_EQ(why_not(start_search(space, scenario, annealing(), {valid})).where, "m");
  const auto neighbourhood = search::one_parameter_neighbourhood(space, valid);
  Rng rng(4);
  std::set<std::string> complaints;
  for (int i = 0; i < 100; ++i) {
    const auto next = neighbourhood.perturb(valid, rng);
    complaints.insert(next ? "" : next.error().where);
  }
  EXPECT_EQ(complaints, (std::set<std::string>{"", "m"}));
}

TEST(Annealing, StartsWhereItsNeighbourhoodStarts) {
  const ParameterSpace space = weights_space(2);
  Configuration start(2);
  start.set(0, 1.25);
  start.set(1, -3.5);
  Scenario scenario;
  scenario.max_experiments = 1000;
  for (const bool at_random : {false, true}) {
    SearchOptions options = annealing();
    std::get<AnnealingOptions>(options).start_at_random = at_random;
    const auto search = value_of(start_search(space, scenario, options, {}, {},
                                              search::one_parameter_neighbourhood(space, start)));
    EXPECT_EQ(search->configuration(at_random ? 2 : 1), start);
  }
}

/// With "b" forbidden there is a start and no step.
TEST(Annealing, EndsWithoutElitesWhenThereIsNoStep) {
  const auto is_b =
      Expression::call(Operation::Equal, {Expression::parameter("mode"), Expression::text("b")});
  const ParameterSpace space =
      ParameterSpace::make({{"mode", "--mode ", Categorical{{"a", "b"}}, {}}}, {is_b}, 2).value();
  auto search = started(space, annealing(), 1000);
  const Played played = play(*search, [](const Configuration&, const Experiment&) { return 1.0; });
  ASSERT_TRUE(search->failure());
  EXPECT_EQ(to_string(*search->failure()), "no configuration besides the incumbent is allowed");
  EXPECT_TRUE(search->wanted().empty());
  EXPECT_TRUE(played.elites.empty());
  const auto finished = only<RaceFinished>(played.events);
  ASSERT_EQ(finished.size(), 1U);
  EXPECT_EQ(finished[0].reason, "no configuration besides the incumbent is allowed");
  EXPECT_TRUE(finished[0].elites.empty());
  EXPECT_EQ(to_string(search->least_extension().error()), finished[0].reason);
  EXPECT_EQ(to_string(search->extend(1000).error()), finished[0].reason);
}

}  // namespace
}  // namespace swarmsmith
