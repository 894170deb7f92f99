#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "base/rng.h"
#include "irace_core/internal/race.h"
#include "irace_core/iterated_race.h"
#include "tests/irace_core/event_digest.h"

namespace swarmsmith::irace {
namespace {

constexpr int kSeeds = 300;

/// What a random race is made of; equal seeds give equal races.
struct Given {
  RaceSettings settings;
  std::vector<Contestant> contestants;
  double rejects = 0;  ///< share of runs that reject
  bool ties = false;   ///< costs are small integers
  std::uint64_t seed = 0;
};

/// Of a run without a bound; the same whenever it is asked for.
double time_of(const Given& given, std::int64_t id, std::int64_t pair) {
  Rng rng(given.seed * 1'000'003 + static_cast<std::uint64_t>(id * 1'009 + pair));
  const double skill = static_cast<double>(id % 7);
  const double time = 1 + skill * rng.uniform() + static_cast<double>(pair % 3);
  return given.ties ? std::floor(time) + 1 : time;
}

bool rejects(const Given& given, std::int64_t id, std::int64_t pair) {
  Rng rng(given.seed * 7'777'777 + static_cast<std::uint64_t>(id * 31 + pair * 10'007));
  return rng.uniform() < given.rejects;
}

Given random_race(std::uint64_t seed, bool with_rejections) {
  Rng rng(seed);
  Given given{.settings = {}, .contestants = {}, .rejects = 0, .ties = false, .seed = seed};
  if (with_rejections) given.rejects = 0.03;
  given.ties = rng.uniform() < 0.3;
  RaceSettings& settings = given.settings;
  settings.elitist = rng.uniform() < 0.7;
  settings.test_type = static_cast<TestType>(rng.below(4));
  settings.pairs_between_tests = 1 + static_cast<std::int64_t>(rng.below(3));
  settings.first_test =
      settings.pairs_between_tests * (1 + static_cast<std::int64_t>(rng.below(4)));
  settings.elitist_limit = static_cast<std::int64_t>(rng.below(4));
  settings.min_survival = 1 + static_cast<std::int64_t>(rng.below(4));
  settings.max_experiments = 20 + static_cast<std::int64_t>(rng.below(300));
  const bool later = settings.elitist && rng.uniform() < 0.7;
  settings.past_pairs = later ? 1 + static_cast<std::int64_t>(rng.below(12)) : 0;
  settings.new_pairs =
      later ? settings.pairs_between_tests * static_cast<std::int64_t>(rng.below(2)) : 0;
  settings.pairs.resize(40);
  std::iota(settings.pairs.begin(), settings.pairs.end(), std::int64_t{1});
  rng.shuffle(std::span(settings.pairs));
  const auto elites = later ? 1 + rng.below(4) : 0;
  const auto count = 3 + rng.below(20);
  for (std::uint64_t i = 0; i < count; ++i) {
    Contestant contestant{static_cast<std::int64_t>(i) + 1, {}, {}};
    for (std::int64_t task = 0; i < elites && task < settings.past_pairs; ++task) {
      const auto pair = settings.pairs[static_cast<std::size_t>(settings.new_pairs + task)];
      const bool known = task == 0 || rng.uniform() < 0.8;
      const double time = known ? time_of(given, contestant.id, pair) : std::nan("");
      contestant.past.push_back(time);
      contestant.past_times.push_back(time);
    }
    given.contestants.push_back(std::move(contestant));
  }
  return given;
}

Measurement measure(const Given& given, const Race& race, const RaceRun& run) {
  const std::int64_t id = race.contestant(run.column).id;
  const std::int64_t pair = race.pair_of(run.task);
  const double full = time_of(given, id, pair);
  const double time = run.bound > 0 ? std::min(full, run.bound) : full;
  return {rejects(given, id, pair) ? std::numeric_limits<double>::infinity() : time, time};
}

struct Outcome {
  std::vector<RaceStep> steps;
  std::vector<std::int64_t> survivors;
  std::int64_t used = 0;
  std::size_t asked = 0;
  std::string reason;
  std::uint64_t answer = 0;  ///< digest of ranks, results and rejections
};

/// Runs a race on a farm that works through each batch in an order of its own.
Outcome run(const Given& given, std::uint64_t order = 0) {
  Race race(given.settings, given.contestants);
  Rng rng(order);
  Outcome outcome;
  while (!race.finished()) {
    const auto wanted = race.wanted();
    std::vector<std::size_t> turns(wanted.size());
    std::iota(turns.begin(), turns.end(), std::size_t{0});
    if (order != 0) rng.shuffle(std::span(turns));
    std::vector<Measurement> answers(wanted.size());
    for (const std::size_t i : turns)
      answers[i] = measure(given, race, wanted[i]);
    outcome.asked += wanted.size();
    race.tell(answers);
  }
  outcome.steps = race.take_steps();
  testing::EventDigest answer;
  for (const Race::Survivor& survivor : race.survivors()) {
    outcome.survivors.push_back(race.contestant(survivor.column).id);
    answer.add(survivor.rank);
  }
  for (std::size_t column = 0; column < race.size(); ++column) {
    answer.add(race.is_rejected(column));
    for (const Race::Result& result : race.results(column)) {
      answer.add(result.pair), answer.add(result.cost), answer.add(result.time);
      answer.add(result.replaces);
    }
  }
  outcome.answer = answer.value64();
  outcome.used = race.used();
  outcome.reason = race.stop_reason();
  EXPECT_FALSE(race.failure().has_value());
  return outcome;
}

std::uint64_t digest_of(const RaceStep& step) {
  testing::EventDigest digest;
  digest.add(step);
  return digest.value64();
}

void expect_same(const Outcome& a, const Outcome& b) {
  EXPECT_EQ(a.used, b.used);
  EXPECT_EQ(a.survivors, b.survivors);
  EXPECT_EQ(a.reason, b.reason);
  ASSERT_EQ(a.steps.size(), b.steps.size());
  for (std::size_t i = 0; i < a.steps.size(); ++i)
    EXPECT_EQ(digest_of(a.steps[i]), digest_of(b.steps[i])) << "task " << i + 1;
  EXPECT_EQ(a.answer, b.answer);
}

/// Calls `check(given)` for races of all sorts.
template <class Check>
void for_races(Check check) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Given given = random_race(seed, seed % 2 == 0);
    switch (seed % 5) {
      case 3:
        given.settings.target_evaluator = true;
        break;
      case 4:
        if (!given.settings.elitist) break;
        given.settings.capping = true;
        given.settings.bound_type = seed % 3 == 0 ? BoundType::Instance : BoundType::Candidate;
        given.settings.capping_type = static_cast<CappingType>(seed % 4);
        given.settings.capping_after_first_test = seed % 7 == 0;
        given.settings.bound_max = 8;
        break;
      default:
        break;
    }
    check(given);
  }
}

/// The races of another kRaceVersion may differ.
TEST(RaceProperty, IsWhatTheVersionOfTheRacePromises) {
  constexpr std::uint64_t kOfVersion2 = 657491455279814804U;
  ASSERT_EQ(kRaceVersion, 2) << "the digest is that of another version";
  testing::EventDigest all;
  for_races([&all](const Given& given) {
    const Outcome outcome = run(given);
    all.add(outcome.steps);
    all.add(outcome.survivors);
    all.add(static_cast<std::int64_t>(outcome.answer));
  });
  EXPECT_EQ(all.value64(), kOfVersion2);
}

/// Costs that are all equal drop no configuration in a t-test, so that all comes as foretold.
TEST(RaceProperty, ForetellsWhatItWantsIfNoneIsDropped) {
  std::size_t foretold = 0;
  for_races([&](Given given) {
    given.settings.test_type = TestType::TTest;
    given.settings.elitist_limit = 0;
    for (Contestant& contestant : given.contestants) {
      for (double& cost : contestant.past)
        cost = std::isnan(cost) ? cost : 1;
    }
    Race race(given.settings, given.contestants);
    if (race.finished()) return;
    const std::vector<RaceRun> ahead = race.ahead(100);
    for (const std::int64_t pairs : {0, 1, 3}) {
      std::set<std::size_t> tasks;
      std::vector<RaceRun> first;
      for (const RaceRun& run : ahead) {
        tasks.insert(run.task);
        if (static_cast<std::int64_t>(tasks.size()) > pairs) break;
        first.push_back(run);
      }
      EXPECT_EQ(race.ahead(pairs), first);
    }
    if (given.settings.capping || given.settings.target_evaluator) {
      EXPECT_TRUE(ahead.empty());
      return;
    }
    std::vector<RaceRun> wanted;
    for (bool is_first = true; !race.finished(); is_first = false) {
      if (!is_first) wanted.insert(wanted.end(), race.wanted().begin(), race.wanted().end());
      race.tell(std::vector<Measurement>(race.wanted().size(), Measurement{1, 1}));
    }
    EXPECT_TRUE(race.ahead(100).empty());
    EXPECT_EQ(ahead, wanted);
    foretold += ahead.size();
  });
  EXPECT_GT(foretold, 1000U);
}

TEST(RaceProperty, AnyOrderOfAnswersGivesTheSameRace) {
  for_races([](const Given& given) {
    const Outcome one = run(given);
    expect_same(one, run(given, 1));
    expect_same(one, run(given, 2));
  });
}

TEST(RaceProperty, BatchesAndSingleTasksGiveTheSameRace) {
  for_races([](const Given& given) {
    Given single = given;
    single.settings.one_task_at_a_time = true;
    const Outcome batches = run(given);
    const Outcome tasks = run(single);
    expect_same(batches, tasks);
    EXPECT_GE(batches.asked, tasks.asked);
    if (given.rejects == 0) {
      EXPECT_EQ(batches.asked, tasks.asked);
    }
    // One at a time, nothing is run in vain.
    if (!given.settings.target_evaluator) {
      EXPECT_EQ(static_cast<std::int64_t>(tasks.asked), tasks.used);
    }
  });
}

TEST(RaceProperty, CountsTheRunsOfItsSteps) {
  for_races([](const Given& given) {
    const Outcome outcome = run(given);
    std::int64_t counted = 0;
    std::set<std::int64_t> gone;
    for (const RaceStep& step : outcome.steps) {
      for (const auto& [id, pair] : step.evaluated)
        EXPECT_FALSE(gone.contains(id)) << id << " had left before task " << step.task;
      for (const Elimination& elimination : step.eliminations)
        EXPECT_TRUE(gone.insert(elimination.configuration).second);
      counted += static_cast<std::int64_t>(step.evaluated.size());
      EXPECT_EQ(step.experiments_used, counted);
      EXPECT_EQ(step.alive_after,
                static_cast<std::int64_t>(given.contestants.size() - gone.size()));
    }
    EXPECT_EQ(outcome.used, counted);
  });
}

TEST(RaceProperty, KeepsElitesUntilTheirPairsAreCovered) {
  int dropped_elites = 0;
  for_races([&](const Given& given) {
    const auto first_past = given.settings.new_pairs;
    for (const RaceStep& step : run(given).steps) {
      for (const Elimination& elimination : step.eliminations) {
        if (elimination.reason == EliminationReason::Rejection) continue;
        const auto& past =
            given.contestants[static_cast<std::size_t>(elimination.configuration - 1)].past;
        if (past.empty()) continue;
        ++dropped_elites;
        for (std::size_t i = 0; i < past.size(); ++i) {
          if (std::isnan(past[i])) continue;
          EXPECT_LE(first_past + static_cast<std::int64_t>(i) + 1, step.task);
        }
      }
    }
  });
  EXPECT_GT(dropped_elites, 10);
}

TEST(RaceProperty, EndsWithinItsBudgetWithoutPastPairs) {
  int compared = 0;
  for_races([&](const Given& given) {
    const RaceSettings& settings = given.settings;
    const Outcome outcome = run(given);
    for (std::size_t i = 1; i < outcome.steps.size(); ++i) {
      const auto before = static_cast<std::int64_t>(i);
      const bool may_stop = before >= settings.first_test &&
                            before % settings.pairs_between_tests == 0 && settings.past_pairs == 0;
      if (!may_stop || outcome.steps[i].evaluated.empty()) continue;
      ++compared;
      const auto runs = static_cast<std::int64_t>(outcome.steps[i].evaluated.size());
      EXPECT_LE(outcome.steps[i - 1].experiments_used + runs * settings.pairs_between_tests,
                settings.max_experiments);
    }
  });
  EXPECT_GT(compared, 100);
}

/// Whether a rule of irace facts, 9.3.2, ended the race; the other reasons are budgets and pairs.
bool ended_by_rule(const Outcome& outcome) {
  return outcome.reason.starts_with("configurations alive") ||
         outcome.reason.starts_with("experiments up to the next test") ||
         outcome.reason.starts_with("tests without elimination");
}

TEST(RaceProperty, StopsOnlyWhenASurvivorHasSeenEachNewAndPastPair) {
  int stopped = 0;
  int after_a_loss = 0;
  for_races([&](const Given& given) {
    const RaceSettings& settings = given.settings;
    const Outcome outcome = run(given);
    if (settings.past_pairs == 0 || !ended_by_rule(outcome)) return;
    ++stopped;
    after_a_loss += given.rejects > 0 ? 1 : 0;
    const auto first = static_cast<std::size_t>(settings.new_pairs);
    std::map<std::int64_t, std::set<std::int64_t>> seen;  // pairs by survivor
    for (const std::int64_t id : outcome.survivors) {
      const auto& past = given.contestants[static_cast<std::size_t>(id - 1)].past;
      seen[id];
      for (std::size_t i = 0; i < past.size(); ++i) {
        if (!std::isnan(past[i])) seen[id].insert(settings.pairs[first + i]);
      }
    }
    for (const RaceStep& step : outcome.steps) {
      for (const auto& [id, pair] : step.evaluated) {
        if (seen.contains(id)) seen[id].insert(pair);
      }
    }
    const auto count = static_cast<std::size_t>(settings.new_pairs + settings.past_pairs);
    for (std::size_t task = 0; task < count; ++task) {
      const std::int64_t pair = settings.pairs[task];
      EXPECT_TRUE(std::ranges::any_of(
          seen, [&](const auto& survivor) { return survivor.second.contains(pair); }))
          << "no survivor has seen pair " << pair << "; " << outcome.reason;
    }
    for (const auto& [id, pairs] : seen) {
      EXPECT_EQ(static_cast<std::int64_t>(pairs.size()) % settings.pairs_between_tests, 0)
          << "configuration " << id;
    }
  });
  EXPECT_GT(stopped, 50);
  EXPECT_GT(after_a_loss, 20);
}

}  // namespace
}  // namespace swarmsmith::irace
