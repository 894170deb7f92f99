#include "irace_core/internal/postselection.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <vector>

#include "tests/irace_core/costs.h"
#include "tests/irace_core/spaces.h"
#include "tests/support/checks.h"
#include "tests/support/not_empty.h"

namespace swarmsmith {
namespace {

using namespace swarmsmith::testing;
using irace::choose_for_postselection;
using irace::largest_set_that_fits;
using irace::PostselectionCandidate;
using Positions = std::vector<std::size_t>;

std::vector<PostselectionCandidate> missing(const std::vector<std::int64_t>& counts) {
  std::vector<PostselectionCandidate> candidates;
  for (const std::int64_t count : counts)
    candidates.push_back({static_cast<std::int64_t>(candidates.size()) + 1, count});
  return candidates;
}

TEST(Postselection, FindsTheFirstOfTheLargestSets) {
  const auto set = [](const std::vector<std::int64_t>& needs, std::int64_t budget) {
    return largest_set_that_fits(needs, budget);
  };
  EXPECT_EQ(set({5, 1, 1, 4}, 6), (Positions{1, 2, 3}));
  EXPECT_EQ(set({3, 3, 3}, 6), (Positions{0, 1}));
  EXPECT_EQ(set({3, 2, 3, 1}, 5), (Positions{0, 1}));
  EXPECT_THAT(set({7, 8}, 6), IsEmpty());
  EXPECT_THAT(set({}, 6), IsEmpty());
}

/// The greedy choice against all subsets.
TEST(Postselection, FindsWhatTryingAllSetsFinds) {
  Rng rng(4);
  for (int round = 0; round < 300; ++round) {
    std::vector<std::int64_t> needs(1 + rng.below(9));
    for (std::int64_t& need : needs)
      need = rng.uniform_int(0, 12);
    const std::int64_t budget = rng.uniform_int(0, 30);
    Positions best;
    for (std::uint64_t mask = 0; mask < (1U << needs.size()); ++mask) {
      Positions chosen;
      std::int64_t sum = 0;
      for (std::size_t i = 0; i < needs.size(); ++i) {
        if ((mask >> i & 1U) == 0) continue;
        chosen.push_back(i);
        sum += needs[i];
      }
      if (sum > budget) continue;
      if (chosen.size() > best.size() || (chosen.size() == best.size() && chosen < best)) {
        best = chosen;
      }
    }
    EXPECT_EQ(largest_set_that_fits(needs, budget), best);
  }
}

TEST(Postselection, TakesThoseThatMissNothingWhenTheyUseUpTheBudget) {
  EXPECT_EQ(choose_for_postselection(missing({0, 3, 0, 0, 0}), 3, 1), (Positions{0, 2, 3}));
  EXPECT_EQ(choose_for_postselection(missing({0, 3, 0, 0, 0}), 7, 2), (Positions{0, 2, 3}));
  // Two steps fit, and the first one would fit beside one of the others; with one step it is first.
  EXPECT_EQ(choose_for_postselection(missing({1, 0, 0}), 5, 2), (Positions{1, 2}));
  EXPECT_EQ(choose_for_postselection(missing({1, 0, 0}), 3, 2), (Positions{0}));
}

TEST(Postselection, TakesTheMostThatFitOtherwise) {
  // q = 11, and only two miss nothing: 1 + 1 + 4 + 3, and then 2 are left for one that needs 7.
  EXPECT_EQ(choose_for_postselection(missing({0, 6, 0, 3, 2}), 11, 1), (Positions{0, 2, 3, 4}));
  // What needs more than all that is left is not among the sixteen.
  std::vector<std::int64_t> counts(40, 100);
  counts[0] = counts[20] = counts[39] = 0;
  EXPECT_EQ(choose_for_postselection(missing(counts), 30, 1), (Positions{0, 20, 39}));
  EXPECT_EQ(choose_for_postselection(missing(std::vector<std::int64_t>(40, 0)), 60, 1).size(), 16U);
}

TEST(Postselection, ComparesWhatIsThereWhenNoPairIsLeft) {
  EXPECT_EQ(choose_for_postselection(missing({0, 3, 0, 9, 2}), 6, 0), (Positions{0, 1, 2, 4}));
  EXPECT_EQ(choose_for_postselection(missing({0}), 6, 0), (Positions{0}));
  EXPECT_EQ(choose_for_postselection(missing({0, 6}), 6, 0), (Positions{0, 1}));
  EXPECT_EQ(choose_for_postselection(missing({0, 7}), 6, 0), (Positions{0}));
}

ParameterSpace small_space() {
  return space_of({make_categorical("kind", {"a", "b", "c"}), make_real("x", 0, 10),
                   make_integer("n", 1, 100, true), make_ordinal("size", {"s", "m", "l"})});
}

Scenario small_scenario(std::uint64_t seed) {
  Scenario scenario;
  scenario.max_experiments = 1000;
  scenario.n_instances = 7;
  scenario.seed = seed;
  return scenario;
}

TEST(PostselectionRace, UsesTheRestAndProtectsNoneLonger) {
  int raced = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    auto race = IteratedRace::start(small_space(), small_scenario(seed)).value();
    const auto events = run_to_end(race, synthetic_cost);
    const auto starts = only<IterationStarted>(events);
    const auto ends = only<IterationEnded>(events);
    EXPECT_LE(race.experiments_used(), 1000);
    for (std::size_t i = 0; i + 1 < starts.size(); ++i)
      EXPECT_FALSE(starts[i].postselection);
    if (!starts.back().postselection) {
      EXPECT_LE(ends.back().remaining, 1);
      continue;
    }
    ++raced;
    EXPECT_EQ(starts.back().budget, ends[ends.size() - 2].remaining);
    EXPECT_EQ(starts.back().iteration, ends[ends.size() - 2].iteration + 1);
    EXPECT_GE(starts.back().n_configurations, 2);
    EXPECT_EQ(static_cast<std::int64_t>(starts.back().elites.size()),
              starts.back().n_configurations);
    EXPECT_EQ(starts.back().new_pairs, 0);
    EXPECT_GT(ends.back().used, 0);
    EXPECT_FALSE(ends.back().elites.empty());
    EXPECT_EQ(only<RaceFinished>(events).front().elites, ends.back().elites);
    // None is dropped before all the pairs are covered.
    for (const RaceStep& step : only<RaceStep>(events)) {
      if (step.iteration != starts.back().iteration || step.eliminations.empty()) continue;
      for (const Elite& elite : ends.back().elites)
        EXPECT_GE(elite.n, step.task);
    }
  }
  EXPECT_GT(raced, 10);
}

/// irace facts, 14: it takes more than one test's pairs for one configuration.
TEST(PostselectionRace, BeginsWithTwoExperimentsAndNotWithOne) {
  std::map<std::int64_t, int> left_over;  // by what was left
  std::map<std::int64_t, int> raced;
  for (std::int64_t budget = 200; budget < 300; ++budget) {
    Scenario scenario = small_scenario(static_cast<std::uint64_t>(budget));
    scenario.max_experiments = budget;
    auto race = IteratedRace::start(small_space(), scenario).value();
    const auto events = run_to_end(race, synthetic_cost);
    const IterationStarted last = only<IterationStarted>(events).back();
    if (last.postselection) {
      ++raced[last.budget];
    } else {
      ++left_over[only<IterationEnded>(events).back().remaining];
    }
  }
  EXPECT_GT(raced[2], 0);
  EXPECT_GT(left_over[1], 0);
  EXPECT_EQ(left_over[2], 0);
  EXPECT_EQ(raced[1], 0);
}

TEST(PostselectionRace, CanBeTurnedOff) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Scenario scenario = small_scenario(seed);
    scenario.postselection = false;
    auto race = IteratedRace::start(small_space(), scenario).value();
    for (const auto& started : not_empty(only<IterationStarted>(run_to_end(race, synthetic_cost))))
      EXPECT_FALSE(started.postselection);
  }
}

TEST(PostselectionRace, KeepsElitesWhenEverythingElseFails) {
  int rejected_all = 0;
  int kept_elites = 0;
  const auto ids_of = [](std::span<const Elite> elites) {
    std::vector<std::int64_t> ids;
    for (const Elite& elite : elites)
      ids.push_back(elite.configuration);
    return ids;
  };
  int kept_others = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    auto race = IteratedRace::start(small_space(), small_scenario(seed)).value();
    bool last_race = false;
    std::vector<std::int64_t> contestants;  // of the last race
    std::set<std::int64_t> rejected;
    std::vector<std::vector<std::int64_t>> ended;  // the elites of each iteration
    std::map<std::int64_t, std::int64_t> runs;
    while (!race.finished()) {
      std::vector<double> costs;
      for (const Experiment& wanted : race.wanted()) {
        costs.push_back(last_race
                            ? std::numeric_limits<double>::infinity()
                            : synthetic_cost(race.configuration(wanted.configuration), wanted));
      }
      race.tell(costs);
      for (const RaceEvent& event : race.take_events()) {
        if (const auto* step = std::get_if<RaceStep>(&event)) {
          for (const auto& [id, pair] : step->evaluated)
            ++runs[id];
          for (const Elimination& dropped : step->eliminations) {
            if (dropped.reason == EliminationReason::Rejection) {
              rejected.insert(dropped.configuration);
            }
          }
        }
        if (const auto* end = std::get_if<IterationEnded>(&event))
          ended.push_back(ids_of(end->elites));
        const auto* started = std::get_if<IterationStarted>(&event);
        if (started == nullptr || !started->postselection) continue;
        last_race = true;
        contestants = started->elites;
      }
    }
    // One that knows the pair on which all others are rejected stays, and wins.
    const bool all_rejected =
        std::ranges::all_of(contestants, [&](std::int64_t id) { return rejected.contains(id); });
    if (!last_race || !all_rejected) continue;
    ++rejected_all;
    EXPECT_FALSE(race.failure().has_value());
    ASSERT_FALSE(race.elites().empty());
    ended.pop_back();
    for (std::vector<std::int64_t>& elites : ended)
      std::erase_if(elites, [&](std::int64_t id) { return rejected.contains(id); });
    while (!ended.empty() && ended.back().empty())
      ended.pop_back();
    for (const Elite& elite : race.elites()) {
      EXPECT_FALSE(rejected.contains(elite.configuration));
      EXPECT_EQ(elite.n, runs[elite.configuration])
          << "all its runs, not those until it was an elite";
    }
    if (ended.empty()) {
      ++kept_others;
      EXPECT_EQ(race.elites().size(), 4U) << "2 + log2 of four parameters survive";
      EXPECT_TRUE(std::ranges::is_sorted(race.elites(), {}, &Elite::rank));
      continue;
    }
    ++kept_elites;
    EXPECT_EQ(ids_of(race.elites()), ended.back()) << "the latest elites that are left";
  }
  EXPECT_GT(kept_elites, 0);
  EXPECT_GT(kept_others, 0);
  EXPECT_GT(rejected_all, 3);
}

TEST(PostselectionRace, IsOffWithoutElitism) {
  Scenario scenario = small_scenario(1);
  scenario.elitist = false;
  auto race = IteratedRace::start(small_space(), scenario).value();
  const auto events = run_to_end(race, synthetic_cost);
  for (const auto& started : only<IterationStarted>(events))
    EXPECT_FALSE(started.postselection);
}

}  // namespace
}  // namespace swarmsmith
