#include "irace_core/iterated_race.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>

#include "tests/irace_core/costs.h"
#include "tests/irace_core/spaces.h"
#include "tests/support/checks.h"
#include "tests/support/not_empty.h"

namespace swarmsmith {
namespace {

using namespace swarmsmith::testing;

ParameterSpace small_space() {
  return space_of({make_categorical("kind", {"a", "b", "c"}), make_real("x", 0, 10),
                   make_integer("n", 1, 100, true), make_ordinal("size", {"s", "m", "l"}),
                   active_when(make_real("y", -1, 1), equals("kind", "b"))});
}

Scenario small_scenario(std::uint64_t seed = 1) {
  Scenario scenario;
  scenario.max_experiments = 1500;
  scenario.n_instances = 7;
  scenario.seed = seed;
  return scenario;
}

std::vector<RaceEvent> run(const Scenario& scenario, const Cost& cost = synthetic_cost) {
  auto race = IteratedRace::start(small_space(), scenario);
  EXPECT_TRUE(race.has_value());
  return run_to_end(*race, cost);
}

std::vector<std::uint64_t> digests(const std::vector<RaceEvent>& events) {
  std::vector<std::uint64_t> found;
  for (const RaceStep& step : only<RaceStep>(events))
    found.push_back(step.digest);
  return found;
}

TEST(IteratedRace, SameSeedGivesTheSameRaceBitForBit) {
  EXPECT_EQ(digests(run(small_scenario(5))), digests(run(small_scenario(5))));
  EXPECT_NE(digests(run(small_scenario(5))), digests(run(small_scenario(6))));
}

TEST(IteratedRace, DecisionsAreFixed) {
  // A change here changes every campaign that was ever recorded.
  const auto events = run(small_scenario(5));
  Digest all;
  for (const std::uint64_t digest : digests(events))
    all.add(digest);
  EXPECT_EQ(all.value64(), 15617215254616353560U);
  EXPECT_EQ(only<RaceFinished>(events).front().elites.front().configuration, 287);
}

TEST(IteratedRace, ImprovesOnItsFirstConfigurations) {
  const auto events = run(small_scenario());
  const auto ends = only<IterationEnded>(events);
  ASSERT_GE(ends.size(), 3U);
  EXPECT_LT(ends.back().elites.front().mean, ends.front().elites.front().mean);
}

TEST(IteratedRace, StaysWithinItsBudget) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const auto events = run(small_scenario(seed));
    std::int64_t used = 0;
    for (const IterationEnded& end : only<IterationEnded>(events)) {
      used += end.used;
      EXPECT_EQ(end.remaining, 1500 - used);
    }
    EXPECT_LE(used, 1500) << "seed " << seed;
    EXPECT_EQ(only<RaceFinished>(events).size(), 1U);
  }
}

TEST(IteratedRace, CountsWhatItReports) {
  const auto events = run(small_scenario());
  std::int64_t evaluated = 0;
  for (const RaceStep& step : not_empty(only<RaceStep>(events))) {
    evaluated += static_cast<std::int64_t>(step.evaluated.size());
    EXPECT_EQ(step.experiments_used, evaluated);
  }
}

TEST(IteratedRace, NeverAsksTwiceForOneConfigurationOnOnePair) {
  auto race = IteratedRace::start(small_space(), small_scenario()).value();
  std::set<std::pair<std::int64_t, std::int64_t>> seen;
  while (!race.finished()) {
    std::vector<double> costs;
    for (const Experiment& wanted : not_empty(race.wanted())) {
      EXPECT_TRUE(seen.emplace(wanted.configuration, wanted.pair).second);
      costs.push_back(synthetic_cost(race.configuration(wanted.configuration), wanted));
    }
    race.tell(costs);
  }
}

TEST(IteratedRace, GivesAllConfigurationsTheSameSeedOnAPair) {
  std::map<std::int64_t, Experiment> by_pair;
  run(small_scenario(), [&](const Configuration& configuration, const Experiment& wanted) {
    const auto [known, added] = by_pair.emplace(wanted.pair, wanted);
    EXPECT_EQ(known->second.seed, wanted.seed);
    EXPECT_EQ(known->second.instance, wanted.instance);
    EXPECT_TRUE(wanted.instance >= 1 && wanted.instance <= 7);
    EXPECT_TRUE(wanted.seed >= 1 && wanted.seed <= 2147483647);
    return synthetic_cost(configuration, wanted);
  });
  // Each repetition of the list has every instance once.
  std::set<std::int64_t> first_seven;
  for (std::int64_t pair = 1; pair <= 7; ++pair)
    first_seven.insert(by_pair.at(pair).instance);
  EXPECT_EQ(first_seven.size(), 7U);
}

TEST(IteratedRace, WantsExperimentsInCanonicalOrder) {
  auto race = IteratedRace::start(small_space(), small_scenario()).value();
  std::size_t asked = 0;
  while (!race.finished()) {
    std::set<std::int64_t> finished_pairs;
    const auto wanted = race.wanted();
    asked += wanted.size();
    for (std::size_t i = 1; i < wanted.size(); ++i) {
      if (wanted[i].pair == wanted[i - 1].pair) {
        EXPECT_LT(wanted[i - 1].configuration, wanted[i].configuration);
      } else {
        EXPECT_TRUE(finished_pairs.insert(wanted[i - 1].pair).second);
      }
    }
    std::vector<double> costs;
    for (const Experiment& experiment : wanted) {
      costs.push_back(synthetic_cost(race.configuration(experiment.configuration), experiment));
    }
    race.tell(costs);
  }
  EXPECT_GT(asked, 1000U);
}

TEST(IteratedRace, DropsNoEliteThatHasSeenMoreThanItsRivals) {
  int dropped_elites = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::map<std::int64_t, std::set<std::int64_t>> pairs;  // by configuration
    std::map<std::int64_t, std::int64_t> known_before;     // of the elites, in this iteration
    for (const RaceEvent& event : not_empty(run(small_scenario(seed)))) {
      if (const auto* started = std::get_if<IterationStarted>(&event)) {
        known_before.clear();
        for (const std::int64_t elite : started->elites) {
          known_before[elite] = static_cast<std::int64_t>(pairs[elite].size());
        }
      }
      const auto* step = std::get_if<RaceStep>(&event);
      if (step == nullptr) continue;
      for (const auto& [id, seen] : step->evaluated)
        pairs[id].insert(step->pair);
      for (const Elimination& dropped : step->eliminations) {
        if (!known_before.contains(dropped.configuration)) continue;
        ++dropped_elites;
        EXPECT_GE(step->task, known_before[dropped.configuration]) << "seed " << seed;
        EXPECT_GE(pairs[step->best].size(), pairs[dropped.configuration].size());
      }
    }
  }
  EXPECT_GT(dropped_elites, 0);
}

TEST(IteratedRace, SamplesOnlyValidConfigurations) {
  const ParameterSpace space = small_space();
  for (const ConfigurationSampled& sampled :
       not_empty(only<ConfigurationSampled>(run(small_scenario())))) {
    EXPECT_TRUE(space.check(sampled.configuration).has_value()) << sampled.id;
    EXPECT_EQ(sampled.configuration.is_active(4), sampled.configuration[0] == 1);
  }
}

TEST(IteratedRace, NumbersConfigurationsFromOneWithoutGaps) {
  std::int64_t last = 0;
  for (const ConfigurationSampled& sampled :
       not_empty(only<ConfigurationSampled>(run(small_scenario())))) {
    EXPECT_EQ(sampled.id, ++last);
    EXPECT_LT(sampled.parent, sampled.id);
    EXPECT_EQ(sampled.parent == 0, sampled.iteration == 1);
  }
}

TEST(IteratedRace, AvoidsForbiddenConfigurations) {
  const Expression clause =
      call(Operation::And, equals("kind", "a"), call(Operation::Less, name("x"), number(8)));
  ParameterSpace space =
      space_of({make_categorical("kind", {"a", "b"}), make_real("x", 0, 10)}, {clause});
  Scenario scenario = small_scenario();
  auto race = IteratedRace::start(space, scenario).value();
  for (const auto& sampled :
       not_empty(only<ConfigurationSampled>(run_to_end(race, synthetic_cost)))) {
    EXPECT_FALSE(space.is_forbidden(sampled.configuration));
  }
}

TEST(IteratedRace, TakesGivenConfigurationsFirst) {
  const ParameterSpace space = small_space();
  Configuration given(space.size());
  for (const auto& [index, value] : {std::pair{0, 0.0}, {1, 2.5}, {2, 10.0}, {3, 1.0}}) {
    given.set(static_cast<std::size_t>(index), value);
  }
  auto race = IteratedRace::start(space, small_scenario(), {given}).value();
  EXPECT_EQ(race.configuration(1), given);
  EXPECT_EQ(race.wanted().front().configuration, 1);
  EXPECT_EQ(only<ConfigurationSampled>(race.take_events()).front().iteration, 0);
}

TEST(IteratedRace, RefusesGivenConfigurationsThatAreNotInTheSpace) {
  Configuration given(5);
  const auto race = IteratedRace::start(small_space(), small_scenario(), {given});
  ASSERT_FALSE(race.has_value());
  EXPECT_THAT(to_string(race.error()), HasSubstr("initial configuration 1, kind"));
}

TEST(IteratedRace, SaysTheSmallestBudgetThatWorks) {
  Scenario scenario = small_scenario();
  scenario.max_experiments = 10;
  const auto refused = IteratedRace::start(small_space(), scenario);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(to_string(refused.error()),
            "max_experiments: a budget of 10 experiments is too small: with these settings it must "
            "be at least 180");
  scenario.max_experiments = 179;
  EXPECT_FALSE(IteratedRace::start(small_space(), scenario).has_value());
  scenario.max_experiments = 180;
  EXPECT_TRUE(IteratedRace::start(small_space(), scenario).has_value());
}

TEST(IteratedRace, RaisesTheBudgetToMinExperiments) {
  Scenario scenario = small_scenario();
  scenario.max_experiments = 10;
  scenario.min_experiments = 10;
  EXPECT_EQ(IteratedRace::start(small_space(), scenario).value().budget(), 180);
}

TEST(IteratedRace, ForbidsWhatWasRejected) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  // Rejected for good: category b, so that whole combinations with b die again and again.
  std::set<std::uint64_t> rejected;
  const ParameterSpace space = space_of(
      {make_categorical("kind", {"a", "b"}), make_integer("n", 1, 40), make_integer("k", 1, 3)});
  Scenario scenario = small_scenario();
  auto race = IteratedRace::start(space, scenario).value();
  const auto events = run_to_end(race, [&](const Configuration& c, const Experiment& wanted) {
    if (c[0] == 1) return kInfinity;
    return synthetic_cost(c, wanted);
  });
  for (const RaceEvent& event : events) {
    if (const auto* sampled = std::get_if<ConfigurationSampled>(&event)) {
      EXPECT_FALSE(sampled->iteration > 1 && rejected.contains(sampled->configuration.digest()));
    }
    if (const auto* step = std::get_if<RaceStep>(&event)) {
      for (const Elimination& dropped : step->eliminations) {
        if (dropped.reason != EliminationReason::Rejection) continue;
        rejected.insert(race.configuration(dropped.configuration).digest());
      }
    }
    if (const auto* end = std::get_if<IterationEnded>(&event)) {
      for (const Elite& elite : end->elites) {
        EXPECT_EQ(race.configuration(elite.configuration)[0], 0);
      }
    }
  }
  EXPECT_FALSE(rejected.empty());
  EXPECT_FALSE(race.failure().has_value());
}

TEST(IteratedRace, CountsNoRunsThatARejectionMadeVoid) {
  auto race = IteratedRace::start(small_space(), small_scenario()).value();
  const auto events = run_to_end(race, [](const Configuration& c, const Experiment& wanted) {
    const bool crashes = c[2] > 50 && wanted.pair % 2 == 0;
    return crashes ? -std::numeric_limits<double>::infinity() : synthetic_cost(c, wanted);
  });
  std::set<std::int64_t> rejected;
  std::int64_t counted = 0;
  for (const RaceStep& step : only<RaceStep>(events)) {
    for (const auto& [id, pair] : step.evaluated)
      EXPECT_FALSE(rejected.contains(id));
    counted += static_cast<std::int64_t>(step.evaluated.size());
    for (const Elimination& dropped : step.eliminations) {
      if (dropped.reason == EliminationReason::Rejection) rejected.insert(dropped.configuration);
    }
  }
  EXPECT_FALSE(rejected.empty());
  EXPECT_EQ(counted, race.experiments_used());
}

TEST(IteratedRace, TellsItsProgress) {
  auto race = IteratedRace::start(small_space(), small_scenario()).value();
  EXPECT_EQ(race.iteration(), 1);
  EXPECT_EQ(race.n_iterations(), 4);
  EXPECT_EQ(race.experiments_used(), 0);
  EXPECT_EQ(race.remaining(), 1500);
  EXPECT_EQ(race.n_alive(), race.n_configurations());
  const std::vector<double> costs(race.wanted().size(), 1);
  race.tell(costs);
  EXPECT_EQ(race.experiments_used(), static_cast<std::int64_t>(costs.size()));
}

TEST(IteratedRace, RacesEqualCostsToTheEnd) {
  // Nothing can ever be told apart: the limit of tests without elimination ends each race.
  const auto events =
      run(small_scenario(), [](const Configuration&, const Experiment&) { return 1.0; });
  for (const RaceStep& step : only<RaceStep>(events)) {
    EXPECT_EQ(step.eliminations.size(), 0U);
    EXPECT_FALSE(step.p_value.has_value());
  }
  EXPECT_FALSE(only<RaceFinished>(events).front().elites.empty());
}

TEST(IteratedRace, FailsWhenEverythingIsRejected) {
  auto race = IteratedRace::start(small_space(), small_scenario()).value();
  run_to_end(race, [](const Configuration&, const Experiment&) {
    return std::numeric_limits<double>::infinity();
  });
  ASSERT_TRUE(race.failure().has_value());
  EXPECT_EQ(race.failure()->message, "every configuration was rejected");
  EXPECT_THAT(race.elites(), IsEmpty());
  EXPECT_THAT(race.alive(), IsEmpty());
}

/// Elites of earlier races do not help: they were rejected, too, and what lost to them is not
/// an answer.
TEST(IteratedRace, FailsWhenASecondRaceRejectsAllOfItsContestants) {
  auto race = IteratedRace::start(small_space(), small_scenario()).value();
  std::vector<IterationEnded> ended;
  while (!race.finished()) {
    std::vector<double> costs;
    for (const Experiment& wanted : race.wanted()) {
      costs.push_back(ended.empty()
                          ? synthetic_cost(race.configuration(wanted.configuration), wanted)
                          : std::numeric_limits<double>::infinity());
    }
    race.tell(costs);
    for (IterationEnded& end : only<IterationEnded>(race.take_events()))
      ended.push_back(std::move(end));
  }
  ASSERT_EQ(ended.size(), 2U);
  EXPECT_FALSE(ended[0].elites.empty());
  EXPECT_THAT(ended[1].elites, IsEmpty());
  ASSERT_TRUE(race.failure().has_value());
  EXPECT_EQ(race.failure()->message, "every configuration was rejected");
  EXPECT_THAT(race.elites(), IsEmpty());
}

TEST(IteratedRace, RefusesCostsThatBreakTheContract) {
  auto race = IteratedRace::start(small_space(), small_scenario()).value();
  std::vector<double> costs(race.wanted().size(), 1);
  costs.back() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(race.tell(costs), std::invalid_argument);
  costs.pop_back();
  EXPECT_THROW(race.tell(costs), std::invalid_argument);
  EXPECT_THROW(race.configuration(0), std::out_of_range);
}

TEST(IteratedRace, KeepsEachEliteOnce) {
  const auto events = run(small_scenario());
  for (const IterationEnded& end : not_empty(only<IterationEnded>(events))) {
    std::set<std::int64_t> ids;
    double last_rank = 0;
    for (const Elite& elite : end.elites) {
      EXPECT_TRUE(ids.insert(elite.configuration).second);
      EXPECT_GE(elite.rank, last_rank);
      last_rank = elite.rank;
    }
  }
}

TEST(IteratedRace, RestartsSoftlyWhenConfigurationsAreAlike) {
  // A space of eight points is exhausted at once.
  const ParameterSpace space = space_of({make_categorical("kind", {"a", "b", "c", "d"}),
                                         make_categorical("more", {"a", "b", "c", "d"})});
  Scenario scenario = small_scenario();
  scenario.max_experiments = 600;
  auto race = IteratedRace::start(space, scenario).value();
  const auto starts = only<IterationStarted>(run_to_end(race, synthetic_cost));
  ASSERT_GE(starts.size(), 2U);
  EXPECT_FALSE(starts.front().soft_restart);
  EXPECT_TRUE(starts[1].soft_restart);
}

TEST(IteratedRace, ReportsAnEmptyDependentDomainWithItsParameter) {
  std::vector<Parameter> parameters{make_integer("n", 1, 9)};
  parameters.push_back({"m", "", Integer{4.0, name("n")}, {}});
  const auto race = IteratedRace::start(space_of(std::move(parameters)), small_scenario());
  ASSERT_FALSE(race.has_value());
  EXPECT_EQ(race.error().where, "m");
}

TEST(IteratedRace, HonoursTheCapOnConfigurations) {
  Scenario scenario = small_scenario();
  scenario.max_configurations_per_race = 12;
  for (const IterationStarted& start : not_empty(only<IterationStarted>(run(scenario)))) {
    EXPECT_LE(start.n_configurations, 12);
  }
}

TEST(IteratedRace, StopsAtTheIterationsThatWereAskedFor) {
  Scenario scenario = small_scenario();
  scenario.nb_iterations = 2;
  const auto events = run(scenario);
  const auto starts = only<IterationStarted>(events);
  ASSERT_EQ(starts.size(), 3U);
  EXPECT_FALSE(starts[1].postselection);
  EXPECT_TRUE(starts[2].postselection);
  EXPECT_EQ(only<RaceFinished>(events).front().reason, "limit of iterations");
}

TEST(IteratedRace, ReportsForbiddenGivenConfigurationsWithoutRacingThem) {
  const ParameterSpace space = space_of(
      {make_categorical("kind", {"a", "b"}), make_real("x", 0, 10)}, {equals("kind", "b")});
  std::vector<Configuration> given(2, Configuration(2));
  given[0].set(0, 1);
  given[0].set(1, 3);
  given[1].set(0, 0);
  given[1].set(1, 3);
  auto race = IteratedRace::start(space, small_scenario(), given).value();
  const auto events = run_to_end(race, synthetic_cost);
  ASSERT_EQ(only<RaceWarning>(events).size(), 1U);
  EXPECT_EQ(only<RaceWarning>(events).front().text,
            "initial configuration 1 is forbidden and takes no part in the races");
  EXPECT_EQ(only<ConfigurationSampled>(events).front().id, 1);  // ids have no gaps
  std::set<std::int64_t> raced;
  for (const RaceStep& step : only<RaceStep>(events))
    for (const auto& [id, pair] : step.evaluated)
      raced.insert(id);
  EXPECT_FALSE(raced.contains(1));
  EXPECT_TRUE(raced.contains(2));
}

TEST(IteratedRace, SaysHowManyGivenConfigurationsHaveNoRoom) {
  const ParameterSpace space = space_of(
      {make_categorical("kind", {"a", "b"}), make_real("x", 0, 10)}, {equals("kind", "b")});
  Scenario scenario = small_scenario();
  scenario.nb_configurations = 10;
  const auto warnings = [&](int allowed) {
    std::vector<Configuration> given;
    for (int i = 0; i <= allowed; ++i) {
      given.emplace_back(2);
      given.back().set(0, i == 0 ? 1 : 0);  // the first is forbidden
      given.back().set(1, 0.5 * i);
    }
    auto race = IteratedRace::start(space, scenario, given).value();
    std::string text;
    for (const RaceWarning& warning : only<RaceWarning>(race.take_events()))
      text += warning.text + "; ";
    return text;
  };
  const std::string forbidden =
      "initial configuration 1 is forbidden and takes no part in the races; ";
  EXPECT_EQ(warnings(10), forbidden);
  EXPECT_EQ(warnings(12), forbidden +
                              "only 10 of the 12 initial configurations take part: the "
                              "first race has no room for more; ");
}

TEST(IteratedRace, UsesFreshPairsInEachRaceWithoutElitism) {
  Scenario scenario = small_scenario();
  scenario.elitist = false;
  std::map<std::int64_t, std::int64_t> iteration_of;
  const auto events = run(scenario);
  for (const RaceStep& step : only<RaceStep>(events)) {
    EXPECT_EQ(iteration_of.emplace(step.pair, step.iteration).first->second, step.iteration);
  }
  EXPECT_GE(only<IterationStarted>(events).size(), 3U);
  for (const IterationStarted& started : only<IterationStarted>(events))
    EXPECT_EQ(started.new_pairs, 0);
}

TEST(IteratedRace, RunsADeterministicTargetOnceOnEachInstance) {
  for (const bool elitist : {true, false}) {
    Scenario scenario = small_scenario();
    scenario.deterministic = true;
    scenario.elitist = elitist;
    std::set<std::pair<std::int64_t, std::int64_t>> ran;  // (configuration, instance)
    auto race = IteratedRace::start(small_space(), scenario).value();
    const auto events = run_to_end(race, [&](const Configuration& c, const Experiment& wanted) {
      EXPECT_TRUE(ran.emplace(wanted.configuration, wanted.instance).second);
      return synthetic_cost(c, wanted);
    });
    EXPECT_GE(only<IterationStarted>(events).size(), 3U);
    EXPECT_EQ(static_cast<std::int64_t>(ran.size()), race.experiments_used());
    std::set<std::int64_t> instances;
    for (const auto& [configuration, instance] : ran)
      instances.insert(instance);
    EXPECT_GE(instances.size(), 5U);  // of seven
  }
}

/// Blocks of the past are never torn apart, nor are those of the list.
TEST(IteratedRace, KeepsBlocksTogether) {
  Scenario scenario = small_scenario();
  scenario.n_instances = 8;
  scenario.block_size = 2;
  scenario.max_experiments = 3000;
  std::int64_t steps = 0;
  std::int64_t last = 0;
  bool shuffled = false;
  std::int64_t iteration = 0;
  for (const RaceStep& step : only<RaceStep>(run(scenario))) {
    ++steps;
    if (step.task % 2 == 0) {
      EXPECT_EQ(step.pair, last + 1);
      EXPECT_EQ(step.pair % 2, 0);
    } else if (step.iteration == iteration && step.pair < last) {
      shuffled = true;
    }
    last = step.pair;
    iteration = step.iteration;
  }
  EXPECT_GT(steps, 20);
  EXPECT_TRUE(shuffled);
}

TEST(IteratedRace, NumbersTheCallsOfTheEvaluatorByTheStepsThatTheyGet) {
  Scenario scenario = small_scenario();
  scenario.target_evaluator = true;
  auto race = IteratedRace::start(small_space(), scenario).value();
  std::int64_t steps = 0;
  std::int64_t calls = 0;
  while (!race.finished()) {
    std::int64_t task = 0;
    std::vector<double> costs;
    for (const Experiment& wanted : race.wanted()) {
      if (wanted.is_evaluation) {
        task = wanted.task;
        ++calls;
      }
      costs.push_back(synthetic_cost(race.configuration(wanted.configuration), wanted));
    }
    race.tell(costs);
    const auto reported = only<RaceStep>(race.take_events());
    if (task > 0) {
      EXPECT_EQ(task, steps + 1);
    }
    steps += static_cast<std::int64_t>(reported.size());
  }
  EXPECT_GT(calls, race.experiments_used());
  EXPECT_LE(race.experiments_used(), 1500);
}

TEST(IteratedRace, EndsWithTheRepairThatLeavesTheSpace) {
  int calls = 0;
  const Repair repair = [&](const Configuration& sampled) -> Expected<Configuration> {
    Configuration changed = sampled;
    if (++calls > 100) changed.set(1, 11);
    return changed;
  };
  auto race = IteratedRace::start(small_space(), small_scenario(), {}, repair).value();
  run_to_end(race, synthetic_cost);
  ASSERT_TRUE(race.failure().has_value());
  EXPECT_THAT(to_string(*race.failure()), HasSubstr("x = 11"));
  EXPECT_EQ(calls, 101);
}

/// Each round of the second race asks the repair for what is still missing, and a hundred rounds
/// give nothing.
TEST(IteratedRace, GivesUpWhenAHundredRoundsGiveOnlyForbiddenConfigurations) {
  const ParameterSpace space = space_of(
      {make_categorical("kind", {"a", "b"}), make_real("x", 0, 10)}, {equals("kind", "b")});
  bool forbids = false;
  int calls = 0;
  const Repair repair = [&](const Configuration& sampled) -> Expected<Configuration> {
    Configuration changed = sampled;
    changed.set(0, forbids ? 1 : 0);
    calls += forbids ? 1 : 0;
    return changed;
  };
  auto race = IteratedRace::start(space, small_scenario(), {}, repair).value();
  forbids = true;
  run_to_end(race, synthetic_cost);
  ASSERT_TRUE(race.failure().has_value());
  EXPECT_EQ(to_string(*race.failure()),
            "nearly all that is sampled is forbidden: the constraints are too strict; forbid less, "
            "or narrow the domains instead");
  EXPECT_GT(calls, 0);
  EXPECT_EQ(calls % 100, 0);
  EXPECT_NE(calls % 101, 0);
}

TEST(IteratedRace, EndsWithTheRepairThatFailsInAnExtension) {
  bool fails = false;
  const Repair repair = [&](const Configuration& sampled) -> Expected<Configuration> {
    if (fails) return bad_input("no such luck");
    return sampled;
  };
  auto race = IteratedRace::start(small_space(), small_scenario(), {}, repair).value();
  run_to_end(race, synthetic_cost);
  race.tell(std::vector<double>{});
  EXPECT_TRUE(race.take_events().empty()) << "nothing follows the end";
  fails = true;
  EXPECT_TRUE(race.extend(1000));
  EXPECT_TRUE(race.finished());
  ASSERT_TRUE(race.failure().has_value());
  EXPECT_EQ(to_string(*race.failure()), "no such luck");
  EXPECT_THAT(race.elites(), IsEmpty());
}

/// Nothing is dropped: the first race comes to pair 6, which its elites then know.
TEST(IteratedRace, ForetellsNoRunThatADeterministicTargetWouldRepeat) {
  Scenario scenario = small_scenario();
  scenario.deterministic = true;
  scenario.elitist = scenario.postselection = false;
  auto race = IteratedRace::start(small_space(), scenario).value();
  std::set<std::pair<std::int64_t, std::int64_t>> ran;
  std::int64_t foretold = 0;
  while (!race.finished()) {
    std::vector<double> costs;
    for (const Experiment& wanted : race.wanted()) {
      EXPECT_TRUE(ran.emplace(wanted.configuration, wanted.pair).second);
      costs.push_back(static_cast<double>((wanted.configuration + wanted.pair) % 7));
    }
    for (const Experiment& ahead : race.ahead(7)) {
      EXPECT_FALSE(ran.contains({ahead.configuration, ahead.pair}));
      foretold += race.iteration() > 1 ? 1 : 0;
    }
    race.tell(costs);
  }
  EXPECT_GT(foretold, 0);
}

TEST(IteratedRace, SaysWhatItNeedsForAFirstRace) {
  const auto complaint = [](ParameterSpace space, const std::function<void(Scenario&)>& change) {
    Scenario scenario = small_scenario();
    change(scenario);
    return complaint_of(IteratedRace::start(std::move(space), scenario));
  };
  EXPECT_EQ(complaint(space_of({make_real("x", 0, 1)},
                               {call(Operation::LessEqual, name("x"), number(1))}),
                      [](Scenario&) {}),
            "no configuration that is not forbidden was found: the constraints are too strict; "
            "forbid less, or narrow the domains instead");
  const std::vector<std::string> three{"a", "b", "c"};
  EXPECT_EQ(complaint(space_of({make_categorical("c", three)}),
                      [](Scenario& s) { s.min_nb_survival = 3; }),
            "only 3 different configurations were found, and a race needs more than 3, which "
            "survive (min_nb_survival): let fewer survive, or give the parameters more values");
  EXPECT_EQ(complaint(space_of({make_categorical("c", three)}),
                      [](Scenario& s) { s.min_nb_survival = 2; }),
            "");
  EXPECT_EQ(complaint(small_space(), [](Scenario& s) { s.nb_configurations = 1000; }),
            "not even one race can be run: not enough budget for the number of configurations "
            "asked for (nb_configurations is 1000, and 1500 experiments allow 166): give a larger "
            "budget, or ask for fewer configurations");
}

TEST(IteratedRace, NeedsTimesForCapping) {
  Scenario scenario = small_scenario();
  scenario.capping = true;
  scenario.bound_max = 5;
  for (const double time : {0.0, 0.001}) {
    auto race = value_of(IteratedRace::start(small_space(), scenario));
    race.tell(std::vector<Measurement>(race.wanted().size(), {1, time}));
    EXPECT_EQ(race.failure().has_value(), time == 0);
    if (!race.failure()) continue;
    EXPECT_EQ(race.failure()->message,
              "the run of configuration 1 on pair 1 reported no time, and capping needs one");
  }
}

TEST(IteratedRace, WarnsOfOptionsThatItChanges) {
  const auto warnings = [](ParameterSpace space, const std::function<void(Scenario&)>& change) {
    Scenario scenario = small_scenario();
    change(scenario);
    auto race = value_of(IteratedRace::start(std::move(space), scenario));
    std::string text;
    for (const RaceWarning& warning : only<RaceWarning>(race.take_events()))
      text += warning.text + "; ";
    return text;
  };
  EXPECT_EQ(warnings(small_space(), [](Scenario&) {}), "");
  EXPECT_EQ(warnings(small_space(), [](Scenario& s) { s.first_test = s.mu = 10; }), "");
  EXPECT_EQ(warnings(small_space(), [](Scenario& s) { s.first_test = 10; }), "")
      << "the default value of mu";
  EXPECT_EQ(warnings(small_space(), [](Scenario& s) { s.first_test = 10, s.mu = 7; }),
            "mu is 10 in place of 7: it cannot be less than the pairs before the first test; ");
  EXPECT_EQ(warnings(small_space(), [](Scenario& s) { s.elitist = s.postselection = false; }), "");
  EXPECT_EQ(warnings(small_space(), [](Scenario& s) { s.elitist = false; }),
            "there is no post-selection race, since the races are not elitist; ");
  const auto many = [](std::size_t count) {
    std::vector<Parameter> parameters;
    for (std::size_t i = 0; i < count; ++i)
      parameters.push_back(make_categorical("p" + std::to_string(i), {"a", "b"}));
    return space_of(std::move(parameters));
  };
  const auto enough = [](Scenario& s) { s.max_experiments = 5000; };
  EXPECT_EQ(warnings(many(1111), enough), "");
  EXPECT_EQ(warnings(many(1112), enough),
            "the first configurations are uniform draws: there are Sobol points for 1111 "
            "parameters at most; ");
}

/// In some later race, a model draws an x for which y has no value.
TEST(IteratedRace, EndsWithTheEmptyDomainOfALaterRace) {
  const ParameterSpace space =
      space_of({make_real("x", 0, 1),
                {"y", "", Real{0.0, call(Operation::Subtract, name("x"), number(0.003))}, {}}});
  int failed = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    auto race = IteratedRace::start(space, small_scenario(seed));
    if (!race) continue;
    const auto events = run_to_end(*race, [](const Configuration& c, const Experiment& wanted) {
      return c[0] + 0.01 * static_cast<double>(wanted.pair % 3);
    });
    if (!race->failure()) continue;
    ++failed;
    EXPECT_EQ(race->failure()->where, "y");
    EXPECT_EQ(only<RaceFinished>(events).front().reason, to_string(*race->failure()));
    EXPECT_THAT(only<RaceFinished>(events).front().elites, IsEmpty());
    EXPECT_THAT(race->wanted(), IsEmpty());
  }
  EXPECT_GT(failed, 0);
}

}  // namespace
}  // namespace swarmsmith
