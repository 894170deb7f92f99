#include "coordinator/design/campaign_runner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "base/rng.h"
#include "coordinator/campaign/campaign_file.h"
#include "coordinator/campaign/campaign_rows.h"
#include "coordinator/design/plans.h"
#include "storage/answer.h"

namespace swarmsmith {
namespace {

/// A score that depends on nothing but machine and seed, better for machines with more states.
double score_of(const Task& task) {
  Digest digest;
  digest.add(task.machine);
  const double quality = Rng(digest.value64()).uniform();
  return 10 * quality + Rng(digest.value64()).split("noise", static_cast<std::uint64_t>(task.seed)).normal();
}

Outcome outcome_of(const Task& task) {
  return {.key = task.key, .score = score_of(task), .state_digest = 1, .worker = 1};
}

std::vector<DesignPlan> small_plans(std::int64_t repetitions) {
  Campaign campaign = demo_campaign();
  campaign.repetitions = repetitions;
  campaign.race.max_experiments = 1500;
  campaign.missions.front().test_count = 5;
  auto plans = plans_of(campaign);
  EXPECT_TRUE(plans) << to_string(plans.error());
  return *plans;
}

/// Keeps the rows as a store would: the first evaluation counts, absolute values are replaced.
struct Memory {
  std::vector<Row> rows;

  std::vector<StoredScore> scores() const {
    std::vector<StoredScore> found;
    for (const Row& row : rows) {
      if (const auto* e = std::get_if<EvaluationRow>(&row)) {
        found.push_back({e->key, e->status, e->score, e->state_digest});
      }
    }
    return found;
  }
  std::vector<StoredStep> steps() const {
    std::vector<StoredStep> found;
    for (const Row& row : rows) {
      if (const auto* s = std::get_if<RaceStepRow>(&row)) {
        found.push_back({s->design, s->step, s->digest});
      }
    }
    std::ranges::stable_sort(found, {}, &StoredStep::design);
    return found;
  }
  /// What `verify` and `digest` look at, as texts in an order of their own.
  std::vector<std::string> answer() const {
    std::vector<std::string> texts;
    for (const Row& row : rows) {
      if (in_answer(row) && !std::holds_alternative<DesignStateRow>(row) &&
          !std::holds_alternative<CandidateTotalsRow>(row)) {
        texts.push_back(describe(row));
      }
    }
    std::ranges::sort(texts);
    const auto [first, last] = std::ranges::unique(texts);
    texts.erase(first, last);
    return texts;
  }
};

/// Runs until finished or `limit` outcomes, telling outcomes in an order drawn from `order`.
void run(CampaignRunner& runner, Memory& memory, Rng order, std::size_t limit = ~std::size_t{0}) {
  std::vector<Task> ready;
  while (limit > 0) {
    for (Task& task : runner.take_tasks()) ready.push_back(std::move(task));
    for (Row& row : runner.take_rows()) memory.rows.push_back(std::move(row));
    if (ready.empty()) break;
    const std::size_t chosen = order.below(ready.size());
    std::swap(ready[chosen], ready.back());
    const Task task = std::move(ready.back());
    ready.pop_back();
    runner.tell(outcome_of(task));
    --limit;
  }
  for (Row& row : runner.take_rows()) memory.rows.push_back(std::move(row));
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

TEST(Ids, AreCanonical) {
  EXPECT_EQ(to_string(candidate_id(DesignId{1}, 812)), "c812");
  EXPECT_EQ(to_string(candidate_id(DesignId{2}, 812)), "c1000812");
  EXPECT_EQ(design_of(CandidateId{1000812}), DesignId{2});
  EXPECT_EQ(number_of(CandidateId{1000000}), 1000000);
  EXPECT_EQ(design_of(CandidateId{1000000}), DesignId{1});
}

}  // namespace
}  // namespace swarmsmith
