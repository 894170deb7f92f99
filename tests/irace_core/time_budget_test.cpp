#include "irace_core/internal/time_budget.h"

#include <limits>
#include <set>

#include "tests/irace_core/costs.h"
#include "tests/irace_core/spaces.h"
#include "tests/support/checks.h"
#include "tests/support/not_empty.h"

namespace swarmsmith {
namespace {

using namespace swarmsmith::testing;
using irace::TimeBudget;

Scenario timed_scenario(double max_time) {
  Scenario scenario;
  scenario.max_time = max_time;
  scenario.n_instances = 10;
  scenario.seed = 3;
  return scenario;
}

ParameterSpace small_space() {
  return space_of({make_categorical("kind", {"a", "b", "c"}), make_real("x", 0, 10),
                   make_integer("n", 1, 100, true)});
}

/// Times between 0.5 and 2.5, which differ by configuration and seed.
double time_of(const Configuration& configuration, const Experiment& experiment) {
  Rng noise(configuration.digest() + static_cast<std::uint64_t>(experiment.seed));
  return 0.5 + 2 * noise.uniform();
}

struct TimedRun {
  std::vector<RaceEvent> events;
  double time = 0;  ///< of all that was asked for
  std::int64_t runs = 0;
};

TimedRun run_timed(IteratedRace& race) {
  TimedRun run{race.take_events()};
  while (!race.finished()) {
    std::vector<Measurement> answers;
    for (const Experiment& wanted : race.wanted()) {
      const Configuration& configuration = race.configuration(wanted.configuration);
      double time = time_of(configuration, wanted);
      if (wanted.bound > 0) time = std::min(time, wanted.bound);
      answers.push_back({synthetic_cost(configuration, wanted), time});
      run.time += time;
      ++run.runs;
    }
    race.tell(answers);
    for (RaceEvent& event : race.take_events())
      run.events.push_back(std::move(event));
  }
  return run;
}

TEST(TimeBudget, EstimatesAsTheFactsSay) {
  Scenario scenario = timed_scenario(1000);
  scenario.parallel = 20;
  TimeBudget budget(scenario, 5);
  EXPECT_EQ(budget.first_configurations(), 4);  // 20 at once, 5 pairs
  EXPECT_EQ(budget.bound_for_estimate(), 0);    // 50 >= 1 * 4 * 5
  for (int i = 0; i < 20; ++i)
    budget.count(0.5);
  EXPECT_EQ(budget.mean_time(), 1);  // rounded up, no decimals
  budget.estimate();
  EXPECT_EQ(budget.remaining(), 990);
  EXPECT_EQ(budget.more_configurations(4), 4);  // time for 40 runs, but 4 at once
  for (int i = 0; i < 70; ++i)
    budget.count(0.5);
  EXPECT_EQ(budget.more_configurations(18), 1);  // time for 5 runs
  EXPECT_EQ(budget.more_configurations(1024), 0);
  for (int i = 0; i < 10; ++i)
    budget.count(0.5);
  EXPECT_EQ(budget.more_configurations(20), 0);  // 50 of 50
  budget.end_estimate();
  budget.estimate();
  EXPECT_EQ(budget.mean_time(), 0.5);
  EXPECT_EQ(budget.remaining(), 1900);
  budget.count(5000);
  budget.estimate();
  EXPECT_EQ(budget.remaining(), 0);
}

TEST(TimeBudget, LowersTheBoundOfAnEstimateThatWouldTakeTooLong) {
  Scenario scenario = timed_scenario(1000);
  scenario.bound_max = 60;
  // 50 for two configurations on five pairs: 5 each.
  EXPECT_EQ(TimeBudget(scenario, 5).bound_for_estimate(), 5);
  scenario.bound_max = 4;
  EXPECT_EQ(TimeBudget(scenario, 5).bound_for_estimate(), 0);
  scenario.bound_max = 5;  // 50 are enough
  EXPECT_EQ(TimeBudget(scenario, 5).bound_for_estimate(), 0);
  scenario.bound_max = 5.01;
  EXPECT_EQ(TimeBudget(scenario, 5).bound_for_estimate(), 5);
  // Without bounds, a run is assumed to take 1: 1 for ten runs, rounded up to two decimals.
  scenario = timed_scenario(10);
  scenario.bound_digits = 2;
  EXPECT_EQ(TimeBudget(scenario, 5).bound_for_estimate(), 0.1);
  scenario.max_time = 200;
  EXPECT_EQ(TimeBudget(scenario, 5).bound_for_estimate(), 0);
}

TEST(TimeBudget, TriesNoMoreThan1024Configurations) {
  Scenario scenario = timed_scenario(1e6);
  scenario.parallel = 20;
  TimeBudget budget(scenario, 5);
  budget.count(1);
  EXPECT_EQ(budget.more_configurations(1019), 4);
  EXPECT_EQ(budget.more_configurations(1021), 3);
  EXPECT_EQ(budget.more_configurations(1023), 1);
  EXPECT_EQ(budget.more_configurations(1024), 0);
  scenario.parallel = 10'000;
  EXPECT_EQ(TimeBudget(scenario, 5).first_configurations(), 1024);
  scenario.parallel = 0;
  EXPECT_EQ(TimeBudget(scenario, 5).first_configurations(), 2);
}

TEST(TimedRace, BeginsWithAnEstimateWhoseRunsAreUsedAgain) {
  auto race = IteratedRace::start(small_space(), timed_scenario(3000)).value();
  EXPECT_EQ(race.wanted().size(), 10U);  // two configurations on five pairs
  EXPECT_EQ(race.alive(), (std::vector<std::int64_t>{1, 2}));
  const TimedRun run = run_timed(race);
  ASSERT_FALSE(race.failure().has_value());
  std::set<std::pair<std::int64_t, std::int64_t>> ran;
  std::int64_t batches = 0;
  const IterationStarted* first = nullptr;
  for (const RaceEvent& event : run.events) {
    if (const auto* estimated = std::get_if<TimeEstimated>(&event)) {
      for (const auto& one : estimated->evaluated)
        EXPECT_TRUE(ran.insert(one).second);
      batches += estimated->evaluated.empty() ? 0 : 1;
    }
    if (const auto* started = std::get_if<IterationStarted>(&event); started && !first) {
      first = started;
    }
    if (const auto* step = std::get_if<RaceStep>(&event)) {
      for (const auto& [id, seen] : step->evaluated)
        EXPECT_TRUE(ran.emplace(id, step->pair).second) << id << " on " << step->pair;
    }
  }
  EXPECT_GT(batches, 1);
  ASSERT_NE(first, nullptr);
  EXPECT_EQ(first->new_pairs, 0);
  // 150 for the estimate, at a mean of 1.5 (2, rounded up): about 20 configurations.
  EXPECT_GT(first->elites.size(), 10U);
  EXPECT_EQ(static_cast<std::int64_t>(ran.size()), race.experiments_used());
  EXPECT_EQ(run.runs, race.experiments_used());  // nothing is void without rejections
  EXPECT_NEAR(race.time_used(), run.time, 1e-9 * run.time);
}

TEST(TimedRace, UsesAboutItsTime) {
  for (const double max_time : {800.0, 3000.0}) {
    auto race = IteratedRace::start(small_space(), timed_scenario(max_time)).value();
    const TimedRun run = run_timed(race);
    EXPECT_LT(run.time, 1.05 * max_time);
    EXPECT_GT(run.time, 0.75 * max_time);
    EXPECT_FALSE(race.elites().empty());
    const auto estimates = only<TimeEstimated>(run.events);
    EXPECT_NEAR(estimates.back().used, run.time, 1e-9 * run.time);
    EXPECT_NEAR(estimates.back().mean_time, 1.5, 0.3);
    EXPECT_EQ(estimates.back().remaining, race.remaining());
  }
}

TEST(TimedRace, PlansFewerIterationsWhenTheTimeIsShort) {
  auto race = IteratedRace::start(small_space(), timed_scenario(150)).value();
  const TimedRun run = run_timed(race);
  EXPECT_FALSE(race.failure().has_value());
  const auto warnings = only<RaceWarning>(run.events);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings.front().text,
            "with an estimated time of 2 per run, the remaining time is too short for the usual "
            "number of iterations: there are " +
                std::to_string(race.n_iterations() - 1) +
                ", with few configurations each, and the result may be no better than a random "
                "search");
  // Twice as many as survive.
  EXPECT_EQ(only<IterationStarted>(run.events).front().n_configurations, 6);
}

TEST(TimedRace, FailsWithASentenceWhenTheTimeIsMuchTooShort) {
  auto race = IteratedRace::start(small_space(), timed_scenario(20)).value();
  run_timed(race);
  ASSERT_TRUE(race.failure().has_value());
  EXPECT_EQ(race.failure()->where, "max_time");
  EXPECT_THAT(race.failure()->message, HasSubstr("give more time"));
}

TEST(TimedRace, NeedsTimes) {
  auto race = IteratedRace::start(small_space(), timed_scenario(3000)).value();
  race.tell(std::vector<double>(race.wanted().size(), 1.0));
  ASSERT_TRUE(race.failure().has_value());
  EXPECT_TRUE(race.finished());
  EXPECT_EQ(race.failure()->message,
            "the run of configuration 1 on pair 1 came without its time, which a budget of time "
            "needs: the target must give the cost and the time of each run");
}

TEST(TimedRace, EndsWhenATargetDoesNotStopAtItsBound) {
  Scenario scenario = timed_scenario(3000);
  scenario.bound_max = 12;
  const auto failure = [&](std::size_t run, double time) {
    auto race = IteratedRace::start(small_space(), scenario).value();
    std::vector<Measurement> answers(race.wanted().size(), {1, 12});
    answers[run].time = time;
    race.tell(answers);
    EXPECT_EQ(race.failure().has_value(), race.finished());
    return race.failure() ? to_string(*race.failure()) : "";
  };
  EXPECT_EQ(failure(3, 12.5),
            "the run of configuration 2 on pair 2 took 12.5, more than its bound of 12: a target "
            "must stop itself at the bound");
  EXPECT_THAT(failure(0, 12.02), HasSubstr("configuration 1 on pair 1 took 12.02, more than"));
  EXPECT_EQ(failure(0, 12.01), "") << "what cannot be measured is no error";
}

TEST(TimedRace, SaysWhichDomainIsEmpty) {
  std::vector<Parameter> parameters{make_integer("n", 1, 3)};
  parameters.push_back({"m", "", Integer{4.0, name("n")}, {}});
  const auto race = IteratedRace::start(space_of(std::move(parameters)), timed_scenario(3000));
  ASSERT_FALSE(race.has_value());
  EXPECT_EQ(race.error().where, "m");
}

/// Two at first, then one at a time: some seeds come to an empty domain in a later batch.
TEST(TimedRace, SaysWhichDomainIsEmptyInALaterBatch) {
  const ParameterSpace space =
      space_of({make_real("x", 0, 1),
                {"y", "", Real{0.0, call(Operation::Subtract, name("x"), number(0.1))}, {}}});
  int failed = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Scenario scenario = timed_scenario(3000);
    scenario.seed = seed;
    auto race = IteratedRace::start(space, scenario);
    if (!race) continue;
    while (!race->finished() && race->iteration() == 0)
      race->tell(std::vector<Measurement>(race->wanted().size(), {1, 1}));
    if (!race->failure()) continue;
    ++failed;
    EXPECT_EQ(race->failure()->where, "y");
    EXPECT_TRUE(race->finished());
  }
  EXPECT_GT(failed, 0);
}

TEST(TimedRace, EndsItsEstimateWhenAllConfigurationsWereTried) {
  Scenario scenario = timed_scenario(3000);
  scenario.min_nb_survival = 2;
  auto race =
      IteratedRace::start(space_of({make_categorical("kind", {"a", "b", "c"})}), scenario).value();
  race.tell(std::vector<Measurement>(race.wanted().size(), {1, 1}));
  EXPECT_EQ(race.alive(), std::vector<std::int64_t>{3});
  race.tell(std::vector<Measurement>(race.wanted().size(), {1, 1}));
  const auto started = only<IterationStarted>(race.take_events());
  ASSERT_EQ(started.size(), 1U);
  EXPECT_EQ(started[0].elites, (std::vector<std::int64_t>{1, 2, 3}));
}

TEST(TimedRace, SaysThatAllIsForbidden) {
  const ParameterSpace space =
      space_of({make_real("x", 0, 1)}, {call(Operation::LessEqual, name("x"), number(1))});
  EXPECT_EQ(complaint_of(IteratedRace::start(space, timed_scenario(3000))),
            "no configuration that is not forbidden was found: the constraints are too strict; "
            "forbid less, or narrow the domains instead");
}

TEST(TimedRace, RaisesTimesThatCannotBeMeasured) {
  auto race = IteratedRace::start(small_space(), timed_scenario(100)).value();
  const auto runs = race.wanted().size();
  race.tell(std::vector<Measurement>(runs, {1, 1e-6}));
  EXPECT_NEAR(race.time_used(), 0.01 * static_cast<double>(runs), 1e-12);
}

TEST(TimedRace, LowersBoundMaxToTwiceTheMean) {
  Scenario scenario = timed_scenario(3000);
  scenario.bound_max = 12;
  auto race = IteratedRace::start(small_space(), scenario).value();
  EXPECT_EQ(race.wanted().front().bound, 12);  // 150 for the estimate is enough for 10 runs
  const TimedRun run = run_timed(race);
  ASSERT_FALSE(race.failure().has_value()) << to_string(*race.failure());
  const auto warnings = only<RaceWarning>(run.events);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings.front().text,
            "bound_max, the bound of runs, is lowered from 12 to 4: the runs so far and the "
            "remaining time show that it is much too large");
  EXPECT_EQ(only<TimeEstimated>(run.events).back().bound_max, 4);
}

TEST(TimedRace, TakesGivenConfigurationsFirst) {
  const ParameterSpace space = small_space();
  std::vector<Configuration> given(3, Configuration(3));
  for (std::size_t i = 0; i < 3; ++i) {
    given[i].set(0, static_cast<double>(i));
    given[i].set(1, 1);
    given[i].set(2, 1);
  }
  auto race = IteratedRace::start(space, timed_scenario(3000), given).value();
  const auto first = only<ConfigurationSampled>(race.take_events());
  EXPECT_EQ(first.size(), 3U);
  race.tell(std::vector<Measurement>(race.wanted().size(), {1, 1}));
  // The third given one alone: as many as run at once.
  EXPECT_EQ(race.alive(), std::vector<std::int64_t>{3});
}

TEST(TimedRace, FillsABatchOfGivenConfigurationsWithSampledOnes) {
  const ParameterSpace space = small_space();
  Configuration given(3);
  given.set(0, 0);
  given.set(1, 1);
  given.set(2, 1);
  const auto race = IteratedRace::start(space, timed_scenario(3000), {given}).value();
  std::set<std::int64_t> tried;
  for (const Experiment& experiment : race.wanted())
    tried.insert(experiment.configuration);
  EXPECT_EQ(tried, (std::set<std::int64_t>{1, 2})) << "as many as without the given one";
  EXPECT_EQ(race.configuration(1), given);
}

TEST(TimedRace, LeavesOutWhatTheEstimateRejects) {
  auto race = IteratedRace::start(small_space(), timed_scenario(3000)).value();
  std::vector<Measurement> answers(race.wanted().size(), {1, 1.5});
  for (std::size_t i = 0; i < answers.size(); ++i) {
    if (race.wanted()[i].configuration == 2) {
      answers[i].cost = std::numeric_limits<double>::infinity();
    }
  }
  race.tell(answers);
  const TimedRun run = run_timed(race);
  for (const IterationStarted& started : not_empty(only<IterationStarted>(run.events)))
    EXPECT_THAT(started.elites, Not(Contains(2)));
  for (const RaceStep& step : not_empty(only<RaceStep>(run.events)))
    EXPECT_THAT(step.evaluated, Not(Contains(::testing::Key(2))));
}

TEST(TimedRace, AsksTheEvaluatorInTheEstimateToo) {
  Scenario scenario = timed_scenario(3000);
  scenario.target_evaluator = true;
  auto race = IteratedRace::start(small_space(), scenario).value();
  const std::vector<Experiment> runs(race.wanted().begin(), race.wanted().end());
  race.tell(std::vector<Measurement>(runs.size(), {0, 1.5}));
  ASSERT_EQ(race.wanted().size(), runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    EXPECT_TRUE(race.wanted()[i].is_evaluation);
    EXPECT_EQ(race.wanted()[i].task, race.wanted()[i].pair);
    EXPECT_EQ(race.wanted()[i].pair, runs[i].pair);
  }
  race.tell(std::vector<Measurement>(runs.size(), {7, 0}));
  EXPECT_EQ(race.experiments_used(), static_cast<std::int64_t>(runs.size()));
  const auto events = run_timed(race).events;
  EXPECT_FALSE(race.failure().has_value());
  // A step's calls carry its number.
  EXPECT_GT(only<RaceStep>(events).size(), 10U);
}

}  // namespace
}  // namespace swarmsmith
