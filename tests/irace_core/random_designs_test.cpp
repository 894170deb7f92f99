#include <gmock/gmock.h>

#include <map>
#include <set>

#include "tests/irace_core/event_digest.h"
#include "tests/irace_core/random_designs.h"

namespace swarmsmith {
namespace {

using namespace swarmsmith::testing;

/// What a design did, as far as the properties look at it.
struct Played {
  std::uint64_t digest = 0;  ///< of its events
  std::uint64_t asked = 0;   ///< of its questions, batch by batch
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

/// What can be asked of a race between two batches.
void add_state(const IteratedRace& race, EventDigest& digest) {
  digest.add(race.wanted());
  digest.add(race.alive());
  digest.add(race.elites());
  for (const std::int64_t number :
       {race.experiments_used(), race.budget(), race.remaining(), race.iteration(),
        race.n_iterations(), race.n_alive(), race.n_configurations()})
    digest.add(number);
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

void play(const Design& design, Played& played) {
  auto race = IteratedRace::start(design.space, design.scenario, design.initial, design.repair);
  if (!race) {
    played.end = to_string(race.error());
    EXPECT_GT(played.end.size(), 20U);
    return;
  }
  Counted counted;
  EventDigest digest;
  EventDigest asked;
  for (int batches = 0;; ++batches) {
    ASSERT_LT(batches, 20'000);
    for (const RaceEvent& event : race->take_events()) {
      digest.add(event);
      if (const auto* step = std::get_if<RaceStep>(&event)) {
        for (const auto& [id, seen] : step->evaluated)
          EXPECT_TRUE(counted.emplace(id, step->pair).second) << id << " on " << step->pair;
        EXPECT_EQ(step->experiments_used, static_cast<std::int64_t>(counted.size()));
      }
      if (const auto* estimated = std::get_if<TimeEstimated>(&event))
        counted.insert(estimated->evaluated.begin(), estimated->evaluated.end());
      if (const auto* finished = std::get_if<RaceFinished>(&event)) played.end = finished->reason;
    }
    add_state(*race, asked);
    if (race->finished()) break;
    check_wanted(*race, counted);
    if (::testing::Test::HasFailure()) return;
    std::vector<Measurement> answers;
    for (const Experiment& wanted : race->wanted())
      answers.push_back(answer(race->configuration(wanted.configuration), wanted, design.rejects));
    race->tell(answers);
  }
  EXPECT_EQ(race->experiments_used(), static_cast<std::int64_t>(counted.size()));
  check_elites(*race);
  // A race may go over its share of the budget (irace facts, 9.3), a design over nothing.
  if (design.scenario.max_time == 0) {
    EXPECT_LE(race->experiments_used(), design.scenario.max_experiments);
  }
  if (design.scenario.max_time > 0) digest.add(race->time_used());
  played.digest = digest.value64();
  played.asked = asked.value64();
}

/// A result that changes for the same space, scenario and costs needs another kRaceVersion: a store
/// of the version before could be continued with other races than it began with.
TEST(RandomDesigns, EndWithElitesOrASentenceAsTheVersionOfTheRacePromises) {
  constexpr std::uint64_t kOfVersion2 = 8306114949443795223U;
  ASSERT_EQ(kRaceVersion, 2) << "the digest is that of another version";
  Rng rng(99);
  std::map<std::string, int> ends;
  EventDigest all;
  int finished = 0;
  for (int round = 0; round < 1500; ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    const Design design = random_design(rng);
    Played played;
    play(design, played);
    if (HasFailure()) break;
    finished += played.digest != 0;
    ++ends[played.end.substr(0, 50)];
    all.add(static_cast<std::int64_t>(played.digest));
    all.add(static_cast<std::int64_t>(played.asked));
    if (round % 10 != 0) continue;
    Played again;
    play(design, again);
    EXPECT_EQ(again.digest, played.digest);
    EXPECT_EQ(again.asked, played.asked);
    EXPECT_EQ(again.end, played.end);
  }
  EXPECT_GT(finished, 400);
  for (const auto& [end, count] : ends)
    RecordProperty(end.empty() ? "none" : end, count);
  EXPECT_GT(ends.size(), 5U);
  EXPECT_EQ(all.value64(), kOfVersion2);
}

/// Whether tasks are asked for one by one or many at once decides nothing; only what is run after a
/// rejection, and does not count, differs.
TEST(RandomDesigns, AreTheSameHoweverMuchIsAskedForAtOnce) {
  Rng rng(77);
  int compared = 0;
  for (int round = 0; round < 300; ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    Design design = random_design(rng);
    Played one;
    Played many;
    design.scenario.one_task_at_a_time = true;
    play(design, one);
    design.scenario.one_task_at_a_time = false;
    play(design, many);
    EXPECT_EQ(one.digest, many.digest);
    EXPECT_EQ(one.end, many.end);
    if (HasFailure()) break;
    compared += one.digest != 0;
  }
  EXPECT_GT(compared, 80);
}

}  // namespace
}  // namespace swarmsmith
