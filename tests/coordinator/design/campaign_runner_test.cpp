#include "coordinator/design/campaign_runner.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/rng.h"
#include "coordinator/campaign/campaign_file.h"
#include "coordinator/campaign/campaign_rows.h"
#include "coordinator/design/plans.h"
#include "tests/coordinator/design/memory.h"
#include "tests/support/one_design.h"

namespace swarmsmith {
namespace {

/// A score that depends on nothing but machine and seed, better for machines with more states.
double score_of(const Task& task) {
  Digest digest;
  digest.add(task.machine);
  const double quality = Rng(digest.value64()).uniform();
  return 10 * quality +
         Rng(digest.value64()).split("noise", static_cast<std::uint64_t>(task.seed)).normal();
}

Outcome outcome_of(const Task& task) {
  return {.key = task.key, .measured = {.score = score_of(task), .state_digest = 1}, .worker = 1};
}

std::vector<DesignPlan> small_plans(std::int64_t repetitions) {
  Campaign campaign = one_design_campaign();
  campaign.repetitions = repetitions;
  campaign.race.max_experiments = 1500;
  campaign.missions.front().test_count = 5;
  auto plans = plans_of(campaign);
  EXPECT_TRUE(plans) << to_string(plans.error());
  return *plans;
}

/// Runs until finished or `limit` outcomes, telling outcomes in an order drawn from `order`.
void run(CampaignRunner& runner, Memory& memory, Rng order, std::size_t limit = ~std::size_t{0}) {
  std::vector<Task> ready;
  while (limit > 0) {
    for (Task& task : runner.take_tasks())
      ready.push_back(std::move(task));
    for (Row& row : runner.take_rows())
      memory.rows.push_back(std::move(row));
    if (ready.empty()) break;
    const std::size_t chosen = order.below(ready.size());
    std::swap(ready[chosen], ready.back());
    const Task task = std::move(ready.back());
    ready.pop_back();
    runner.tell(outcome_of(task));
    --limit;
  }
  for (Row& row : runner.take_rows())
    memory.rows.push_back(std::move(row));
}

Memory undisturbed(std::int64_t repetitions) {
  Memory memory;
  CampaignRunner runner(small_plans(repetitions), {}, {});
  run(runner, memory, Rng(1));
  EXPECT_FALSE(runner.error());
  EXPECT_TRUE(runner.finished());
  return memory;
}

TEST(CampaignRunner, OrderOfArrivalChangesNothing) {
  const auto expected = undisturbed(2).answer();
  ASSERT_FALSE(expected.empty());
  for (std::uint64_t seed = 2; seed < 5; ++seed) {
    Memory memory;
    CampaignRunner runner(small_plans(2), {}, {});
    run(runner, memory, Rng(seed));
    EXPECT_EQ(memory.answer(), expected) << "order " << seed;
  }
}

TEST(CampaignRunner, GoesOnFromStoredScoresAsIfNothingHadHappened) {
  const Memory whole = undisturbed(1);
  Rng rng(3);
  for (int attempt = 0; attempt < 6; ++attempt) {
    Memory memory;
    for (int restart = 0; restart < 4; ++restart) {
      CampaignRunner runner(small_plans(1), by_design(memory.scores(), memory.steps(), {}), {});
      ASSERT_FALSE(runner.error()) << to_string(*runner.error());
      run(runner, memory, rng.split("order", static_cast<std::uint64_t>(restart)), rng.below(400));
    }
    CampaignRunner runner(small_plans(1), by_design(memory.scores(), memory.steps(), {}), {});
    run(runner, memory, Rng(9));
    EXPECT_TRUE(runner.finished());
    EXPECT_EQ(memory.answer(), whole.answer()) << "attempt " << attempt;
  }
}

TEST(CampaignRunner, ADesignRacesBeforeItsFirstStep) {
  Memory memory;
  CampaignRunner runner(small_plans(1), {}, {});
  run(runner, memory, Rng(1), 1);
  ASSERT_TRUE(memory.steps().empty());
  const auto states = memory.only<DesignStateRow>();
  ASSERT_EQ(states.size(), 1U);
  EXPECT_EQ(states.front().state, DesignState::Racing);
  EXPECT_EQ(states.front().used, 0);
}

TEST(CampaignRunner, AsksForNothingThatIsStored) {
  const Memory whole = undisturbed(1);
  CampaignRunner runner(small_plans(1), by_design(whole.scores(), whole.steps(), {}), {});
  EXPECT_TRUE(runner.take_tasks().empty());
  EXPECT_TRUE(runner.finished());
}

TEST(CampaignRunner, StopsWhenTheReplayDisagreesWithTheStore) {
  Memory whole = undisturbed(1);
  auto stored = by_design(whole.scores(), whole.steps(), {});
  stored.at(DesignId{1}).step_digests[3] ^= 1U;
  CampaignRunner runner(small_plans(1), stored, {});
  ASSERT_TRUE(runner.error());
  EXPECT_EQ(runner.error()->kind, ErrorKind::Corrupt);
  EXPECT_EQ(runner.error()->where, "d1, step 4");
  EXPECT_FALSE(runner.finished());
}

TEST(CampaignRunner, KeepsTheBudgetAndTestsTheWinnerOnFreshSeeds) {
  const Memory whole = undisturbed(1);
  std::int64_t race = 0;
  std::int64_t tests = 0;
  CandidateId winner;
  for (const Row& row : whole.rows) {
    if (const auto* e = std::get_if<EvaluationRow>(&row)) {
      (e->key.purpose == Purpose::Race ? race : tests) += 1;
    }
    if (const auto* d = std::get_if<DesignStateRow>(&row)) winner = d->best;
  }
  EXPECT_LE(race, 1500);
  EXPECT_GT(race, 1300);
  EXPECT_EQ(tests, 5);
  for (const Row& row : whole.rows) {
    if (const auto* e = std::get_if<EvaluationRow>(&row); e && e->key.purpose == Purpose::Test) {
      EXPECT_EQ(e->key.candidate, winner);
    }
  }
}

TEST(CampaignRunner, TestsABaselineAsItTestsWinners) {
  Campaign campaign = one_design_campaign();
  campaign.repetitions = 2;
  campaign.missions.front().test_count = 5;
  campaign.methods.front().baseline = "--nstates 1 --s0 1";
  campaign.methods.push_back(campaign.methods.front());
  campaign.methods.back().name = "random";
  campaign.methods.back().baseline = kRandomMachine;
  Memory memory;
  CampaignRunner runner(*plans_of(campaign), {}, {});
  run(runner, memory, Rng(1));
  EXPECT_TRUE(runner.finished());
  std::map<DesignId, std::set<std::string>> machines;
  std::map<DesignId, std::set<std::int64_t>> tests;
  for (const Row& row : memory.rows) {
    if (const auto* c = std::get_if<CandidateRow>(&row))
      machines[design_of(c->id)].insert(c->machine);
    if (const auto* e = std::get_if<EvaluationRow>(&row)) {
      EXPECT_EQ(e->key.purpose, Purpose::Test);
      tests[design_of(e->key.candidate)].insert(e->key.pair);
    }
    const auto* state = std::get_if<DesignStateRow>(&row);
    if (state == nullptr || state->state != DesignState::Finished) continue;
    EXPECT_EQ(state->used, 0);
    EXPECT_EQ(state->best, candidate_id(state->design, 1));
  }
  for (const auto& [design, pairs] : tests)
    EXPECT_EQ(pairs.size(), 5U);
  EXPECT_EQ(tests.size(), 3U);
  EXPECT_THAT(machines[{1}], testing::ElementsAre("--nstates 1 --s0 1"));
  EXPECT_EQ(machines[{2}].size(), 1U);
  EXPECT_NE(machines[{2}], machines[{3}]);
}

TEST(CampaignRunner, TellsTheTaskOfAnEvaluationAgain) {
  CampaignRunner runner(small_plans(1), {}, {});
  std::size_t told = 0;
  for (auto tasks = runner.take_tasks(); !tasks.empty(); tasks = runner.take_tasks()) {
    for (const Task& task : tasks) {
      const std::optional<Task> again = runner.task_of(task.key);
      ASSERT_TRUE(again) << to_string(task.key);
      EXPECT_EQ(again->machine, task.machine);
      EXPECT_EQ(again->seed, task.seed);
      EXPECT_EQ(again->instance, task.instance);
      EXPECT_EQ(again->mission, task.mission);
      runner.tell(outcome_of(task));
      ++told;
    }
  }
  EXPECT_GT(told, 1000U);
  EXPECT_FALSE(runner.task_of({{999'999}, Purpose::Race, 1}));
  EXPECT_FALSE(runner.task_of({{1}, Purpose::Race, 99'999}));
}

TEST(CampaignRunner, SaysWhichDesignsAreOverForGood) {
  Memory memory;
  CampaignRunner runner(small_plans(3), {}, {DesignId{2}}, {},
                        {.at_least = 2, .at_most = 2, .finished = 1});
  EXPECT_EQ(runner.take_ended(), std::vector<DesignId>{{2}});
  run(runner, memory, Rng(1));
  ASSERT_TRUE(runner.finished());
  // The last one can be extended yet.
  ASSERT_EQ(runner.take_ended().size(), 1U);
  EXPECT_TRUE(runner.take_ended().empty());
}

TEST(CampaignRunner, KeepsFinishedRacesByTheirSize) {
  Memory memory;
  const std::vector<DesignPlan> plans = small_plans(3);
  const std::int64_t budget = plans.front().row.budget;
  CampaignRunner small(plans, {}, {}, {}, {.finished_experiments = 3 * budget});
  EXPECT_EQ(small.unfinished().size(), 3U);
  run(small, memory, Rng(1));
  ASSERT_TRUE(small.finished());
  EXPECT_TRUE(small.unfinished().empty());
  EXPECT_TRUE(small.take_ended().empty()) << "all can be extended";
  CampaignRunner large(plans, {}, {}, {}, {.finished_experiments = budget / 2});
  run(large, memory, Rng(1));
  ASSERT_TRUE(large.finished());
  EXPECT_EQ(large.take_ended().size(), 2U) << "the last one can be extended in any case";
}

TEST(CampaignRunner, ARejectedCandidateIsDroppedAndItsLaterRunsCountNowhere) {
  Memory memory;
  CampaignRunner runner(small_plans(1), {}, {});
  const std::vector<Task> first = runner.take_tasks();
  ASSERT_GT(first.size(), 10U);
  const CandidateId rejected = first.front().key.candidate;
  for (const Task& task : first) {
    Outcome outcome = outcome_of(task);
    if (task.key == first.front().key) outcome.status = EvaluationStatus::Rejected;
    runner.tell(outcome);
  }
  run(runner, memory, Rng(1));
  std::int64_t unused = 0;
  bool eliminated = false;
  for (const Row& row : memory.rows) {
    if (const auto* u = std::get_if<UnusedRow>(&row)) {
      EXPECT_EQ(u->key.candidate, rejected);
      ++unused;
    }
    if (const auto* e = std::get_if<EliminationRow>(&row); e && e->candidate == rejected) {
      EXPECT_EQ(e->reason, "rejected");
      EXPECT_EQ(e->step, 1);
      eliminated = true;
    }
  }
  EXPECT_EQ(unused, 4) << "of the five pairs before the first test";
  EXPECT_TRUE(eliminated);
}

/// Two designs of 60 experiments, three iterations each.
std::vector<DesignPlan> tiny_plans() {
  std::vector<DesignPlan> plans = small_plans(2);
  for (DesignPlan& plan : plans) {
    plan.row.budget = 60;
    plan.scenario.max_experiments = 60;
    plan.scenario.first_test = 3;
    plan.scenario.mu = 3;
    plan.scenario.nb_iterations = 3;
    plan.scenario.min_nb_survival = 2;
  }
  return plans;
}

TEST(CampaignRunner, ADesignWithoutCandidatesStopsAndTheOthersGoOn) {
  CampaignRunner runner(tiny_plans(), {}, {});
  std::vector<Row> rows;
  for (auto tasks = runner.take_tasks(); !tasks.empty(); tasks = runner.take_tasks()) {
    for (const Task& task : tasks) {
      Outcome outcome = outcome_of(task);
      if (design_of(task.key.candidate) == DesignId{2}) outcome.status = EvaluationStatus::Rejected;
      runner.tell(outcome);
    }
    for (Row& row : runner.take_rows())
      rows.push_back(std::move(row));
  }
  EXPECT_TRUE(runner.finished());
  std::map<DesignId, DesignStateRow> states;
  for (const Row& row : rows) {
    if (const auto* state = std::get_if<DesignStateRow>(&row)) states[state->design] = *state;
    if (const auto* step = std::get_if<RaceStepRow>(&row); step && step->design == DesignId{2}) {
      EXPECT_EQ(step->alive_after, 0);
      EXPECT_EQ(step->best, CandidateId{}) << "a store knows no such candidate";
    }
  }
  EXPECT_EQ(states[DesignId{1}].state, DesignState::Finished);
  EXPECT_EQ(states[DesignId{2}].state, DesignState::Stopped);
  EXPECT_EQ(states[DesignId{2}].best, CandidateId{});
  EXPECT_NE(states[DesignId{2}].reason, "");
}

TEST(CampaignRunner, WantsNoMorePairsThanAStoreCanNumber) {
  for (const std::int64_t tests : {kPairsPerCandidate - 1, kPairsPerCandidate}) {
    Campaign campaign = one_design_campaign();
    campaign.race.max_experiments = 1500;
    campaign.missions.front().test_count = tests;
    CampaignRunner runner(*plans_of(campaign), {}, {});
    Memory memory;
    run(runner, memory, Rng(1), 1500);
    EXPECT_EQ(runner.error() ? runner.error()->message : "",
              tests < kPairsPerCandidate
                  ? ""
                  : "the design needs more than 99999 pairs, the most that it can have: give a "
                    "smaller budget");
  }
}

TEST(CampaignRunner, AsksOnceForWhatItWantsAgainAfterARejectionMadeItUnused) {
  int wanted_again = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    CampaignRunner runner(tiny_plans(), {}, {});
    std::map<EvaluationKey, int> asked;
    std::map<EvaluationKey, std::int64_t> iterations;
    std::map<DesignId, std::int64_t> used;
    for (auto tasks = runner.take_tasks(); !tasks.empty(); tasks = runner.take_tasks()) {
      for (const Task& task : tasks) {
        EXPECT_EQ(++asked[task.key], 1) << to_string(task.key) << ", seed " << seed;
        Outcome outcome = outcome_of(task);
        Rng rng = Rng(seed).split(task.machine, static_cast<std::uint64_t>(task.seed));
        if (rng.bernoulli(0.06)) outcome.status = EvaluationStatus::Rejected;
        runner.tell(outcome);
      }
      for (const Row& row : runner.take_rows()) {
        if (const auto* e = std::get_if<EvaluationRow>(&row); e && e->iteration > 0) {
          const auto [at, fresh] = iterations.try_emplace(e->key, e->iteration);
          if (fresh) continue;
          EXPECT_EQ(at->second, 0) << "only what was unused is given again";
          at->second = e->iteration;
          ++wanted_again;
        }
        if (const auto* u = std::get_if<UnusedRow>(&row)) iterations[u->key] = 0;
        if (const auto* d = std::get_if<DesignStateRow>(&row)) used[d->design] = d->used;
      }
    }
    EXPECT_TRUE(runner.finished());
    std::map<DesignId, std::int64_t> counted;
    for (const auto& [key, iteration] : iterations)
      counted[design_of(key.candidate)] += iteration > 0;
    EXPECT_EQ(counted, used) << "seed " << seed;
  }
  EXPECT_GT(wanted_again, 0);
}

TEST(CampaignRunner, TakesNoScoreThatNoRaceAskedFor) {
  const EvaluationKey key{candidate_id(DesignId{1}, 1), Purpose::Race, 1};
  for (const Purpose purpose : {Purpose::LookAhead, Purpose::Audit, Purpose::Score}) {
    const std::vector<StoredScore> scores = {{.key = {key.candidate, purpose, key.pair},
                                              .status = EvaluationStatus::Ok,
                                              .measured = {.score = 1e6, .state_digest = 1}}};
    CampaignRunner runner(tiny_plans(), by_design(scores, {}, {}), {});
    EXPECT_EQ(runner.take_tasks().front().key, key);
  }
}

TEST(CampaignRunner, StopsWhenTheStoreHasMoreStepsThanTheReplay) {
  const Memory whole = undisturbed(1);
  auto stored = by_design(whole.scores(), whole.steps(), {});
  auto& steps = stored.at(DesignId{1}).step_digests;
  const std::size_t played = steps.size();
  steps.push_back(1);
  CampaignRunner runner(small_plans(1), stored, {});
  ASSERT_TRUE(runner.error());
  EXPECT_EQ(runner.error()->kind, ErrorKind::Corrupt);
  EXPECT_EQ(runner.error()->where, "d1, step " + std::to_string(played + 1));
}

TEST(Ids, AreCanonical) {
  EXPECT_EQ(to_string(candidate_id(DesignId{1}, 812)), "c812");
  EXPECT_EQ(to_string(candidate_id(DesignId{2}, 812)), "c1000812");
  EXPECT_EQ(design_of(CandidateId{1000812}), DesignId{2});
  EXPECT_EQ(number_of(CandidateId{1000000}), 1000000);
  EXPECT_EQ(design_of(CandidateId{1000000}), DesignId{1});
}

}  // namespace
}  // namespace swarmsmith
