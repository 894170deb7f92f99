#include <gtest/gtest.h>

#include <chrono>

#include "tests/irace_core/costs.h"
#include "tests/irace_core/spaces.h"
#include "tests/support/not_empty.h"

namespace swarmsmith {
namespace {

using namespace swarmsmith::testing;

Scenario design_of_a_hundred_thousand() {
  Scenario scenario;
  scenario.max_experiments = 100'000;
  scenario.seed = 3;
  return scenario;
}

TEST(AutomodeSpace, HasTheParametersOfTheThesis) {
  const ParameterSpace space = automode_space();
  EXPECT_EQ(space.size(), 149U);
  EXPECT_EQ(space.variable_count(), 149);
  EXPECT_EQ(space[0].name, "NumStates");
  EXPECT_EQ(space.level(*space.index_of("L3x3")), 4);
}

TEST(AutomodeSpace, IsFilledInOrderOfItsConditions) {
  auto race = IteratedRace::start(automode_space(), design_of_a_hundred_thousand()).value();
  const ParameterSpace& space = race.space();
  const std::size_t states = *space.index_of("NumStates");
  const std::size_t last = *space.index_of("S3");
  const std::size_t target = *space.index_of("N0x0");
  for (const auto& sampled : not_empty(only<ConfigurationSampled>(race.take_events()))) {
    const Configuration& c = sampled.configuration;
    EXPECT_EQ(c.is_active(last), c[states] == 4);
    EXPECT_FALSE(c[target] > std::max(0.0, c[states] - 2));
    EXPECT_TRUE(space.check(c).has_value());
  }
}

/// The schedule at this budget, as irace plans it: d = 149 gives nine iterations, the first ones
/// capped. The time that the race itself takes is recorded, not asserted.
TEST(AutomodeSpace, RacesAHundredThousandExperiments) {
  auto race = IteratedRace::start(automode_space(), design_of_a_hundred_thousand()).value();
  std::chrono::nanoseconds spent{0};
  std::int64_t told = 0;
  std::vector<RaceEvent> events = race.take_events();
  while (!race.finished()) {
    std::vector<double> costs;
    for (const Experiment& wanted : race.wanted()) {
      costs.push_back(synthetic_cost(race.configuration(wanted.configuration), wanted));
    }
    told += static_cast<std::int64_t>(costs.size());
    const auto before = std::chrono::steady_clock::now();
    race.tell(costs);
    spent += std::chrono::steady_clock::now() - before;
    for (RaceEvent& event : race.take_events())
      events.push_back(std::move(event));
  }
  const auto starts = only<IterationStarted>(events);
  ASSERT_GE(starts.size(), 9U);
  EXPECT_EQ(starts.front().n_iterations, 9);
  EXPECT_EQ(starts.front().budget, 11'111);
  // The cap of 1024 less some: a robot that only stops is the same machine each time it is drawn.
  EXPECT_GT(starts.front().n_configurations, 1000);
  EXPECT_LE(starts.front().n_configurations, 1024);
  EXPECT_LE(race.experiments_used(), 100'000);
  EXPECT_EQ(told, race.experiments_used());
  RecordProperty("microseconds_per_experiment", std::to_string(static_cast<double>(spent.count()) /
                                                               1000.0 / static_cast<double>(told)));
  RecordProperty("configurations", std::to_string(race.n_configurations()));
}

}  // namespace
}  // namespace swarmsmith
