#include "irace_core/search/generations.h"
#include "tests/irace_core/search/played.h"
#include "tests/support/checks.h"
#include "tests/support/not_empty.h"

namespace swarmsmith {
namespace {

struct Published {
  std::int64_t budget;
  std::int64_t generations;
  std::int64_t final_runs;
};

/// The parameter files of ARGoS3-NEAT: docs/methods.md.
TEST(GenerationPlan, IsThePublishedOneOfEachPublishedBudget) {
  for (const Published& published : {Published{10'000, 8, 20}, Published{50'000, 40, 100},
                                     Published{100'000, 90, 100}, Published{200'000, 150, 500}}) {
    const auto plan = value_of(search::plan_generations(published.budget, 100, 10, 0));
    EXPECT_EQ(plan.generations, published.generations);
    EXPECT_EQ(plan.final_runs, published.final_runs);
    EXPECT_EQ(plan.generations * 1000 + 100 * plan.final_runs, published.budget);
  }
}

TEST(GenerationPlan, GivesWhatIsLeftToTheFinalStage) {
  const auto plan = value_of(search::plan_generations(10'550, 100, 10, 20));
  EXPECT_EQ(plan.generations, 8);
  EXPECT_EQ(plan.final_runs, 25);
}

TEST(GenerationPlan, HasAtLeastAGenerationAndAFinalStage) {
  // 200 for two runs of each at the end would leave 900 of the 1000 for a generation.
  const auto small = value_of(search::plan_generations(1100, 100, 10, 0));
  EXPECT_EQ(small.generations, 1);
  EXPECT_EQ(small.final_runs, 1);
  EXPECT_EQ(complaint_of(search::plan_generations(1099, 100, 10, 0)),
            "max_experiments: a budget of 1099 experiments is too small: with these settings it "
            "must be at least 1100");
  EXPECT_EQ(complaint_of(search::plan_generations(1199, 100, 10, 2)),
            "max_experiments: a budget of 1199 experiments is too small: with these settings it "
            "must be at least 1200");
  EXPECT_EQ(value_of(search::plan_generations(199'999, 100, 10, 0)).final_runs, 109);
}

TEST(GenerationPlan, ReservesTheFinalStageOfRandomSearch) {
  const auto plan = value_of(search::plan_random_search(12'505, {}));
  EXPECT_EQ(plan.finalists, 12);
  EXPECT_EQ(plan.configurations, 1130);  // (12505 - 1200) / 10
  EXPECT_EQ(plan.generations, 2);        // of a thousand and of 130
  EXPECT_EQ(plan.final_runs, 100);
  EXPECT_EQ(value_of(search::plan_random_search(11'000, {.final_runs = 91})).generations, 1)
      << "11 finalists leave 9999 runs";
  EXPECT_EQ(complaint_of(search::plan_random_search(109, {})),
            "max_experiments: a budget of 109 experiments is too small: with these settings it "
            "must be at least 110");
  EXPECT_EQ(value_of(search::plan_random_search(110, {})).configurations, 1);
  EXPECT_EQ(value_of(search::plan_random_search(1999, {})).finalists, 1);
  EXPECT_EQ(value_of(search::plan_random_search(2000, {})).finalists, 2);
  EXPECT_EQ(complaint_of(search::plan_random_search(329, {.finalists = 3})),
            "max_experiments: a budget of 329 experiments is too small: with these settings it "
            "must be at least 330");
}

TEST(RandomSearch, GivesUpWhenAHundredDrawsAreForbidden) {
  const auto draws = [](std::int64_t forbidden) {
    std::int64_t drawn = 0;
    const auto is_low =
        Expression::call(Operation::Less, {Expression::parameter("x"), Expression::number(0.5)});
    const ParameterSpace space =
        ParameterSpace::make({{"x", "", Real{0.0, 1.0}, {}}}, {is_low}, 2).value();
    const Repair repair = [&](const Configuration&) -> Expected<Configuration> {
      Configuration made(1);
      made.set(0, ++drawn > forbidden ? 0.5 : 0.49);
      return made;
    };
    Rng rng(1);
    const auto made = search::draw_uniform(space, repair, rng);
    return std::to_string(drawn) + (made ? "" : ": " + to_string(made.error()));
  };
  EXPECT_EQ(draws(0), "1");
  EXPECT_EQ(draws(99), "100");
  EXPECT_EQ(draws(100),
            "100: a hundred draws in a row were forbidden: the forbidden clauses exclude too much");
}

TEST(RandomSearch, RunsTheBestAgainOnFurtherPairs) {
  auto search = started(weights_space(3), options_of(SearchKind::Random), 10'000);
  const Played played = play(*search, noisy_sphere);
  const auto iterations = only<IterationStarted>(played.events);
  ASSERT_EQ(iterations.size(), 2U);
  EXPECT_EQ(iterations[0].n_configurations, 900);
  EXPECT_EQ(iterations[1].n_configurations, 10);
  EXPECT_TRUE(iterations[1].postselection);
  EXPECT_EQ(played.elites.size(), 10U);
  for (const Elite& elite : played.elites)
    EXPECT_EQ(elite.n, 100);
  EXPECT_EQ(search->experiments_used(), 10'000);
  // No pair of the final stage was seen before.
  for (const RaceStep& step : only<RaceStep>(played.events))
    EXPECT_EQ(step.iteration == 2, step.pair > 10);
}

TEST(RandomSearch, OfALargerBudgetTriesTheSameConfigurationsFirst) {
  const auto small =
      play(*started(weights_space(3), options_of(SearchKind::Random), 3000), noisy_sphere);
  const auto large =
      play(*started(weights_space(3), options_of(SearchKind::Random), 9000), noisy_sphere);
  const auto few = only<ConfigurationSampled>(small.events);
  const auto many = only<ConfigurationSampled>(large.events);
  ASSERT_LT(few.size(), many.size());
  for (std::size_t i = 0; i < few.size(); ++i)
    EXPECT_EQ(few[i].configuration, many[i].configuration);
}

TEST(RandomSearch, HasNoMoreFinalistsThanItCanDrawAndRunAgain) {
  RandomOptions options;
  options.final_runs = 1000;
  for (const std::int64_t budget : {1010, 10'000, 100'000}) {
    const auto plan = search::plan_random_search(budget, options);
    ASSERT_TRUE(plan);
    EXPECT_EQ(plan->finalists, std::min<std::int64_t>(std::max<std::int64_t>(1, budget / 1000),
                                                      budget / (options.runs + 1000)));
    EXPECT_GE(plan->configurations, plan->finalists);
    EXPECT_GE(plan->final_runs, 1000);
  }
  auto search = started(weights_space(3), options, 10'000);
  play(*search, noisy_sphere);
  EXPECT_EQ(search->elites().size(), 9U);
  EXPECT_LE(search->experiments_used(), 10'000);
}

TEST(RandomSearch, DrawsFromEverySpace) {
  auto search = started(mixed_space(), options_of(SearchKind::Random), 2000);
  play(*search, [](const Configuration& c, const Experiment&) { return c[2]; });
  for (const Elite& elite : not_empty(search->elites()))
    EXPECT_TRUE(search->space().check(search->configuration(elite.configuration)));
}

/// Each draw fails with a chance of 1 in 300, so the first budget seldom meets a failure, and the
/// second does.
TEST(RandomSearch, AnExtensionThatFailsIsTheLast) {
  std::vector<Parameter> parameters;
  parameters.push_back({"x", "", Real{0.0, 1.0}, {}});
  parameters.push_back(
      {"y",
       "",
       Real{0.0, Expression::call(Operation::Subtract,
                                  {Expression::parameter("x"), Expression::number(0.003)})},
       {}});
  const ParameterSpace space = ParameterSpace::make(std::move(parameters), {}, 4).value();
  int failed = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Scenario scenario;
    scenario.max_experiments = 300;
    scenario.n_instances = 1;
    scenario.seed = seed;
    auto begun = start_search(space, scenario, options_of(SearchKind::Random));
    if (!begun) continue;
    const std::unique_ptr<Search> search = std::move(*begun);
    play(*search, noisy_sphere);
    if (search->failure()) continue;
    const auto elites = std::vector<Elite>(search->elites().begin(), search->elites().end());
    const auto extended = search->extend(60'000);
    if (extended) continue;  // fails later
    ++failed;
    EXPECT_TRUE(search->finished());
    EXPECT_EQ(search->elites().size(), elites.size());
    EXPECT_TRUE(search->wanted().empty());
    EXPECT_EQ(to_string(search->extend(60'000).error()), to_string(extended.error()));
  }
  EXPECT_GT(failed, 0);
}

TEST(FRace, IsOneRaceThatEndsWithOneOrItsBudget) {
  auto search = started(weights_space(3), options_of(SearchKind::FRace), 4000);
  const Played played = play(*search, noisy_sphere);
  const auto iterations = only<IterationStarted>(played.events);
  ASSERT_EQ(iterations.size(), 1U);
  EXPECT_EQ(iterations[0].n_configurations, 200);
  EXPECT_EQ(only<ConfigurationSampled>(played.events).size(), 200U);
  const auto steps = only<RaceStep>(played.events);
  EXPECT_TRUE(steps.back().alive_after == 1 ||
              4000 - search->experiments_used() < steps.back().alive_after);
}

}  // namespace
}  // namespace swarmsmith
