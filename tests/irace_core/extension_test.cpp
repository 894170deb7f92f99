#include <algorithm>
#include <set>

#include "tests/irace_core/event_digest.h"
#include "tests/irace_core/random_designs.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

using namespace swarmsmith::testing;

ParameterSpace space_of_four() {
  return space_of({make_categorical("kind", {"a", "b", "c"}), make_real("x", 0, 10),
                   make_integer("n", 1, 40), make_ordinal("size", {"s", "m", "l"})});
}

Scenario scenario_of(std::int64_t experiments) {
  Scenario scenario;
  scenario.seed = 7;
  scenario.n_instances = 10;
  scenario.max_experiments = experiments;
  return scenario;
}

IteratedRace ended(const Scenario& scenario, std::vector<RaceEvent>& events) {
  auto race = IteratedRace::start(space_of_four(), scenario);
  EXPECT_TRUE(race) << to_string(race.error());
  events = run_to_end(*race, synthetic_cost);
  return std::move(*race);
}

IteratedRace ended(const Scenario& scenario) {
  std::vector<RaceEvent> events;
  return ended(scenario, events);
}

std::vector<std::uint64_t> digests(const std::vector<RaceEvent>& events) {
  std::vector<std::uint64_t> found;
  for (const RaceStep& step : only<RaceStep>(events))
    found.push_back(step.digest);
  return found;
}

TEST(Extension, GoesOnFromTheEndWithAllThatIsLeftAsOneIteration) {
  std::vector<RaceEvent> before;
  IteratedRace race = ended(scenario_of(400), before);
  const std::int64_t used = race.experiments_used();
  const std::int64_t last = race.iteration();
  std::vector<std::int64_t> elites;
  for (const Elite& elite : race.elites())
    elites.push_back(elite.configuration);
  ASSERT_TRUE(race.extend(1000));
  EXPECT_FALSE(race.finished());
  EXPECT_EQ(race.budget(), 1400);
  const auto events = run_to_end(race, synthetic_cost);
  const auto started = only<IterationStarted>(events);
  ASSERT_FALSE(started.empty());
  EXPECT_EQ(started.front().iteration, last + 1);
  EXPECT_EQ(started.front().budget, 1400 - used);
  EXPECT_EQ(started.front().elites, elites);
  EXPECT_EQ(started.front().new_pairs, 1) << "the end's shortage of budget is over";
  EXPECT_FALSE(started.front().postselection);
  EXPECT_GT(race.experiments_used(), used + 500);
  EXPECT_LE(race.experiments_used(), 1400);
  EXPECT_EQ(only<RaceFinished>(events).size(), 1U);
}

TEST(Extension, IsTheSameHoweverOftenItIsPlayed) {
  std::vector<std::vector<std::uint64_t>> all;
  for (int round = 0; round < 2; ++round) {
    IteratedRace race = ended(scenario_of(400));
    auto& played = all.emplace_back();
    for (const std::int64_t experiments : {700, 900}) {
      ASSERT_TRUE(race.extend(experiments));
      for (const std::uint64_t digest : digests(run_to_end(race, synthetic_cost)))
        played.push_back(digest);
    }
  }
  EXPECT_EQ(all[0], all[1]);
}

TEST(Extension, IsNotTheDesignThatHadTheLargerBudgetFromTheStart) {
  std::vector<RaceEvent> events;
  IteratedRace race = ended(scenario_of(400), events);
  std::vector<std::uint64_t> extended = digests(events);
  ASSERT_TRUE(race.extend(1000));
  for (const std::uint64_t digest : digests(run_to_end(race, synthetic_cost)))
    extended.push_back(digest);
  std::vector<RaceEvent> whole;
  ended(scenario_of(1400), whole);
  EXPECT_NE(digests(whole), extended);
}

TEST(Extension, RaisesALimitOfIterations) {
  Scenario scenario = scenario_of(600);
  scenario.nb_iterations = 2;
  IteratedRace race = ended(scenario);
  for (const std::int64_t experiments : {800, 800}) {
    ASSERT_TRUE(race.extend(experiments));
    const auto started = only<IterationStarted>(run_to_end(race, synthetic_cost));
    const auto races = std::ranges::count(started, false, &IterationStarted::postselection);
    EXPECT_EQ(races, 1);
  }
}

TEST(Extension, RaisesALimitByWhatTheBudgetOfAnIterationMakesOfIt) {
  Scenario scenario = scenario_of(400);
  scenario.nb_iterations = 2;
  scenario.nb_experiments_per_iteration = 200;
  IteratedRace race = ended(scenario);
  ASSERT_TRUE(race.extend(650));
  const auto started = only<IterationStarted>(run_to_end(race, synthetic_cost));
  EXPECT_GE(std::ranges::count(started, false, &IterationStarted::postselection), 3);
}

TEST(Extension, TheLeastThatIsEnough) {
  for (const std::int64_t experiments : {200, 400, 1000}) {
    const std::int64_t least = *ended(scenario_of(experiments)).least_extension();
    for (const std::int64_t more : {least - 1, least}) {
      IteratedRace race = ended(scenario_of(experiments));
      if (more == 0) continue;
      ASSERT_TRUE(race.extend(more));
      const auto started = only<IterationStarted>(run_to_end(race, synthetic_cost));
      const bool iterates = !started.empty() && !started.front().postselection;
      EXPECT_EQ(iterates, more == least) << more << " after " << experiments;
      EXPECT_LE(race.experiments_used(), experiments + more);
      EXPECT_FALSE(race.failure());
    }
  }
}

TEST(Extension, IsRefusedWithoutAnythingToGoOnFrom) {
  Scenario scenario = scenario_of(400);
  auto race = IteratedRace::start(space_of_four(), scenario);
  run_to_end(*race, [](const Configuration&, const Experiment&) {
    return std::numeric_limits<double>::infinity();
  });
  ASSERT_TRUE(race->failure());
  const std::string nothing = "there is nothing to continue from: every configuration was rejected";
  EXPECT_EQ(complaint_of(race->extend(1000)), nothing);
  EXPECT_EQ(complaint_of(race->least_extension()), nothing);

  scenario.max_experiments = 0;
  scenario.max_time = 400;
  race = IteratedRace::start(space_of_four(), scenario);
  while (!race->finished())
    race->tell(std::vector<Measurement>(race->wanted().size(), Measurement{1, 0.5}));
  EXPECT_EQ(complaint_of(race->extend(1000)),
            "max_time: its budget is time, and an extension is in experiments");
  EXPECT_EQ(complaint_of(race->least_extension()), complaint_of(race->extend(1000)));
}

TEST(Extension, OfRandomDesignsKeepsTheirRulesAndTheVersionOfTheRace) {
  constexpr std::uint64_t kOfVersion2 = 4420393010802914731U;
  ASSERT_EQ(kRaceVersion, 2) << "the digest is that of another version";
  EventDigest all;
  Rng rng(31);
  int extended = 0;
  int iterated = 0;
  for (int round = 0; round < 400; ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    const Design design = random_design(rng);
    const Scenario& scenario = design.scenario;
    auto race = IteratedRace::start(design.space, scenario, design.initial, design.repair);
    const std::int64_t more = rng.uniform_int(1, 600);
    if (!race) continue;
    std::set<std::pair<std::int64_t, std::int64_t>> counted;
    std::int64_t last = 0;
    std::int64_t budget = scenario.max_experiments;
    for (int extension = 0; extension < 3; ++extension) {
      if (extension > 0) {
        const auto least = race->least_extension();
        all.add(least ? *least : -1);
        if (!race->extend(more)) break;
        budget += more;
        ++extended;
      }
      for (;;) {
        for (const RaceEvent& event : race->take_events()) {
          all.add(event);
          if (const auto* started = std::get_if<IterationStarted>(&event)) {
            EXPECT_GT(started->iteration, last) << "no iteration has the number of another";
            last = started->iteration;
            iterated += extension > 0 && !started->postselection;
          }
          if (const auto* step = std::get_if<RaceStep>(&event)) {
            for (const auto& [id, seen] : step->evaluated)
              EXPECT_TRUE(counted.emplace(id, step->pair).second);
          }
          if (const auto* estimated = std::get_if<TimeEstimated>(&event))
            counted.insert(estimated->evaluated.begin(), estimated->evaluated.end());
        }
        if (race->finished()) break;
        std::vector<Measurement> answers;
        for (const Experiment& wanted : race->wanted())
          answers.push_back(
              answer(race->configuration(wanted.configuration), wanted, design.rejects));
        race->tell(answers);
      }
      EXPECT_EQ(race->experiments_used(), static_cast<std::int64_t>(counted.size()));
      if (scenario.max_time == 0) {
        EXPECT_LE(race->experiments_used(), std::max(budget, race->budget()));
        EXPECT_FALSE(!race->failure() && race->elites().empty());
      }
    }
    if (HasFailure()) break;
  }
  EXPECT_GT(extended, 100);
  EXPECT_GT(iterated, 60);
  EXPECT_EQ(all.value64(), kOfVersion2);
}

}  // namespace
}  // namespace swarmsmith
