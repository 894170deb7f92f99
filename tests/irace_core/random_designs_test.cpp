#include <gmock/gmock.h>

#include <map>
#include <set>

#include "tests/irace_core/random_designs.h"

namespace swarmsmith {
namespace {

using namespace swarmsmith::testing;

/// What a design did, as far as the properties look at it.
struct Played {
  std::uint64_t digest = 0;
  std::string end;
};

/// (configuration, pair) of what was run and counted; void runs may be asked for again.
using Counted = std::set<std::pair<std::int64_t, std::int64_t>>;

void check_wanted(const IteratedRace& race, const Counted& counted) {
  ASSERT_FALSE(race.wanted().empty());
  for (const Experiment& wanted : race.wanted()) {
    const bool known = counted.contains({wanted.configuration, wanted.pair});
    EXPECT_FALSE(known && !wanted.is_evaluation)
        << "configuration " << wanted.configuration << " on pair " << wanted.pair;
    EXPECT_FALSE(race.scenario().deterministic && wanted.pair > race.scenario().n_instances);
  }
}

void check_elites(const IteratedRace& race) {
  if (race.failure()) {
    EXPECT_GT(to_string(*race.failure()).size(), 20U);
    EXPECT_TRUE(race.elites().empty());
    return;
  }
  EXPECT_FALSE(race.elites().empty());
  for (const Elite& elite : race.elites())
    EXPECT_GT(elite.n, 0);
}

void play(const ParameterSpace& space, const Scenario& scenario, double rejects, Played& played) {
  auto race = IteratedRace::start(space, scenario);
  if (!race) {
    played.end = to_string(race.error());
    EXPECT_GT(played.end.size(), 20U);
    return;
  }
  Counted counted;
  Digest digest;
  for (int batches = 0; !race->finished(); ++batches) {
    ASSERT_LT(batches, 20'000);
    check_wanted(*race, counted);
    if (::testing::Test::HasFailure()) return;
    std::vector<Measurement> answers;
    for (const Experiment& wanted : race->wanted())
      answers.push_back(answer(race->configuration(wanted.configuration), wanted, rejects));
    race->tell(answers);
    for (const RaceEvent& event : race->take_events()) {
      if (const auto* step = std::get_if<RaceStep>(&event)) {
        digest.add(step->digest);
        for (const auto& [id, seen] : step->evaluated)
          EXPECT_TRUE(counted.emplace(id, step->pair).second) << id << " on " << step->pair;
        EXPECT_EQ(step->experiments_used, static_cast<std::int64_t>(counted.size()));
      }
      if (const auto* estimated = std::get_if<TimeEstimated>(&event)) {
        digest.add(estimated->used);
        counted.insert(estimated->evaluated.begin(), estimated->evaluated.end());
      }
      if (const auto* finished = std::get_if<RaceFinished>(&event)) played.end = finished->reason;
    }
  }
  EXPECT_EQ(race->experiments_used(), static_cast<std::int64_t>(counted.size()));
  check_elites(*race);
  // A race may go over its share of the budget (irace facts, 9.3), a design over nothing.
  if (scenario.max_time == 0) {
    EXPECT_LE(race->experiments_used(), scenario.max_experiments);
  }
  played.digest = digest.value64();
}

TEST(RandomDesigns, EndWithElitesOrASentence) {
  Rng rng(99);
  std::map<std::string, int> ends;
  int finished = 0;
  for (int round = 0; round < 1500; ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    const Scenario scenario = random_scenario(rng);
    const ParameterSpace space = random_space(rng);
    const double rejects = rng.bernoulli(0.3) ? rng.uniform(0, 0.3) : 0;
    Played played;
    play(space, scenario, rejects, played);
    if (HasFailure()) break;
    finished += played.digest != 0;
    ++ends[played.end.substr(0, 50)];
    if (round % 10 != 0) continue;
    Played again;
    play(space, scenario, rejects, again);
    EXPECT_EQ(again.digest, played.digest);
    EXPECT_EQ(again.end, played.end);
  }
  EXPECT_GT(finished, 400);
  for (const auto& [end, count] : ends)
    RecordProperty(end.empty() ? "none" : end, count);
  EXPECT_GT(ends.size(), 5U);
}

/// Whether tasks are asked for one by one or many at once decides nothing; only what is run after a
/// rejection, and does not count, differs.
TEST(RandomDesigns, AreTheSameHoweverMuchIsAskedForAtOnce) {
  Rng rng(77);
  int compared = 0;
  for (int round = 0; round < 300; ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    Scenario scenario = random_scenario(rng);
    const ParameterSpace space = random_space(rng);
    const double rejects = rng.bernoulli(0.3) ? rng.uniform(0, 0.3) : 0;
    Played one;
    Played many;
    scenario.one_task_at_a_time = true;
    play(space, scenario, rejects, one);
    scenario.one_task_at_a_time = false;
    play(space, scenario, rejects, many);
    EXPECT_EQ(one.digest, many.digest);
    EXPECT_EQ(one.end, many.end);
    if (HasFailure()) break;
    compared += one.digest != 0;
  }
  EXPECT_GT(compared, 80);
}

}  // namespace
}  // namespace swarmsmith
