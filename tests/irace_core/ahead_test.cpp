#include <gmock/gmock.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>

#include "irace_core/internal/race.h"
#include "tests/irace_core/costs.h"
#include "tests/irace_core/event_digest.h"
#include "tests/irace_core/random_designs.h"
#include "tests/irace_core/spaces.h"

namespace swarmsmith {
namespace {

using namespace swarmsmith::testing;
using irace::Race;
using irace::RaceRun;
using irace::RaceSettings;

Race race_of(RaceSettings settings, std::int64_t contestants) {
  settings.pairs.resize(20);
  std::iota(settings.pairs.begin(), settings.pairs.end(), std::int64_t{1});
  std::vector<irace::Contestant> all;
  for (std::int64_t id = 1; id <= contestants; ++id)
    all.push_back({id, {}, {}});
  return Race(std::move(settings), std::move(all));
}

RaceSettings wide() {
  RaceSettings settings;
  settings.max_experiments = 1000;
  return settings;
}

std::vector<std::pair<std::size_t, std::size_t>> places(const std::vector<RaceRun>& runs) {
  std::vector<std::pair<std::size_t, std::size_t>> found;
  for (const RaceRun& run : runs)
    found.emplace_back(run.task, run.column);
  return found;
}

TEST(Ahead, ContinuesTheTasksThatAreWanted) {
  const Race race = race_of(wide(), 3);
  EXPECT_EQ(race.wanted().size(), 15U);
  EXPECT_TRUE(race.ahead(0).empty());
  EXPECT_THAT(places(race.ahead(2)),
              ::testing::ElementsAre(std::pair{5U, 0U}, std::pair{5U, 1U}, std::pair{5U, 2U},
                                     std::pair{6U, 0U}, std::pair{6U, 1U}, std::pair{6U, 2U}));
  EXPECT_EQ(race.ahead(100).size(), 45U) << "20 pairs, 5 of them wanted";
}

TEST(Ahead, EndsWhereTheBudgetsEnd) {
  RaceSettings settings = wide();
  settings.max_experiments = 21;  // two more pairs of three
  EXPECT_EQ(race_of(settings, 3).ahead(10).size(), 6U);
  settings.max_experiments = 1000;
  settings.experiments_left = 20;  // one more
  EXPECT_EQ(race_of(settings, 3).ahead(10).size(), 3U);
  settings.experiments_left = 1000;
  settings.min_survival = 3;
  EXPECT_TRUE(race_of(settings, 3).ahead(10).empty());
}

TEST(Ahead, SaysNothingWhereResultsDecideMore) {
  RaceSettings settings = wide();
  settings.one_task_at_a_time = true;
  EXPECT_TRUE(race_of(settings, 3).ahead(10).empty());
  settings = wide();
  settings.target_evaluator = true;
  EXPECT_TRUE(race_of(settings, 3).ahead(10).empty());
  settings = wide();
  settings.capping = true;
  settings.bound_max = 5;
  EXPECT_TRUE(race_of(settings, 3).ahead(10).empty());
}

TEST(Ahead, EndsWithTheRace) {
  Race race = race_of(wide(), 3);
  while (!race.finished())
    race.tell(std::vector<Measurement>(race.wanted().size(), Measurement{1, 0}));
  EXPECT_TRUE(race.ahead(10).empty());
}

/// What a design did, and what was foretold.
struct Foretold {
  std::uint64_t digest = 0;
  std::int64_t used = 0;
  std::int64_t foretold = 0;  ///< experiments
  std::int64_t wanted = 0;    ///< of them, by the race later
  std::int64_t skipped = 0;   ///< wanted at once after a test, and not foretold
};

using Key = std::pair<std::int64_t, std::int64_t>;

Foretold play(const Design& design, std::int64_t pairs) {
  Foretold result;
  auto race = IteratedRace::start(design.space, design.scenario, design.initial, design.repair);
  if (!race) return result;
  std::set<Key> asked;
  std::set<Key> counted;  // what a rejection made void may be asked for again
  std::set<Key> foretold;
  std::vector<Experiment> next;  // foretold with the last batch
  std::int64_t iteration = 0;
  EventDigest digest;
  while (!race->finished()) {
    std::vector<Measurement> answers;
    for (const Experiment& wanted : race->wanted()) {
      asked.emplace(wanted.configuration, wanted.pair);
      if (race->iteration() == iteration && !next.empty()) {
        const bool was_next =
            std::ranges::any_of(next, [&](const Experiment& e) { return e == wanted; });
        result.skipped += !was_next && wanted.pair == next.front().pair;
      }
      answers.push_back(answer(race->configuration(wanted.configuration), wanted, design.rejects));
    }
    iteration = race->iteration();
    next = race->ahead(pairs);
    for (const Experiment& experiment : next) {
      const Key key{experiment.configuration, experiment.pair};
      EXPECT_FALSE(counted.contains(key)) << "configuration " << key.first << " on " << key.second;
      EXPECT_FALSE(experiment.is_evaluation);
      foretold.insert(key);
    }
    race->tell(answers);
    for (const RaceEvent& event : race->take_events()) {
      digest.add(event);
      if (const auto* step = std::get_if<RaceStep>(&event)) {
        for (const auto& [id, seen] : step->evaluated)
          counted.emplace(id, step->pair);
      }
    }
  }
  result.digest = digest.value64();
  result.used = race->experiments_used();
  result.foretold = static_cast<std::int64_t>(foretold.size());
  result.wanted = std::ranges::count_if(foretold, [&](Key key) { return asked.contains(key); });
  return result;
}

TEST(Ahead, ChangesNothingAndForetellsWhatIsWanted) {
  Rng rng(5);
  std::int64_t foretold = 0;
  std::int64_t wanted = 0;
  int compared = 0;
  for (int round = 0; round < 400; ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    const Design design = random_design(rng);
    const Scenario& scenario = design.scenario;
    const Foretold plain = play(design, 0);
    EXPECT_EQ(plain.foretold, 0);
    const Foretold ahead = play(design, rng.uniform_int(1, 5));
    EXPECT_EQ(ahead.digest, plain.digest);
    EXPECT_EQ(ahead.used, plain.used);
    EXPECT_EQ(ahead.skipped, 0);
    if (scenario.max_time > 0 || scenario.target_evaluator || scenario.one_task_at_a_time) {
      EXPECT_EQ(ahead.foretold, 0);
    }
    if (HasFailure()) break;
    foretold += ahead.foretold;
    wanted += ahead.wanted;
    compared += ahead.foretold > 0;
  }
  EXPECT_GT(compared, 60);
  // Little is used of what is foretold for up to five pairs, at every test, in races that are as
  // short and odd as these.
  EXPECT_GT(wanted * 12, foretold);
  RecordProperty("share wanted",
                 std::to_string(static_cast<double>(wanted) / static_cast<double>(foretold)));
}

}  // namespace
}  // namespace swarmsmith
