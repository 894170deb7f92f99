#include "coordinator/audit.h"

#include <gtest/gtest.h>
#include <algorithm>

#include "coordinator/task_key.h"
#include "tests/coordinator/schedulers.h"

namespace swarmsmith {
namespace {

TEST(Audits, ChooseOneOfSoMany) {
  int chosen = 0;
  for (std::int64_t candidate = 1; candidate <= 200'000; ++candidate) {
    const PackedKey key = pack(candidate, 0, 1);
    chosen += Audits::chooses(key, 200);
  }
  // 1,000 of them, give or take four standard deviations.
  EXPECT_NEAR(chosen, 1000, 128);
  EXPECT_FALSE(Audits::chooses(pack(1, 0, 1), 0));
}

struct AuditOfOne : testing::Test {
  Audits audits;
  Task task{.key = {{7}, Purpose::Race, 1}};
  PackedKey key = key_of(task);

  AuditOfOne() { audits.open(task, {.worker = 1, .score = 2.5, .state_digest = 9}); }
};

TEST_F(AuditOfOne, GoesToAnotherWorkerOnly) {
  EXPECT_FALSE(audits.take_for(1));
  EXPECT_FALSE(audits.can_go_on({1}));
  EXPECT_TRUE(audits.can_go_on({1, 2}));
  EXPECT_TRUE(audits.take_for(2));
  EXPECT_FALSE(audits.take_for(3)) << "it is out already";
  EXPECT_TRUE(audits.can_go_on({}));
}

TEST_F(AuditOfOne, IsOverWhenTheBitsAgree) {
  audits.take_for(2);
  const Audits::Verdict verdict = audits.hear(key, {2, 2.5, 9});
  EXPECT_FALSE(verdict.differs);
  EXPECT_FALSE(verdict.outvoted);
  EXPECT_TRUE(audits.empty());
}

TEST_F(AuditOfOne, AsksAThirdWhenTheBitsDiffer) {
  audits.take_for(2);
  EXPECT_TRUE(audits.hear(key, {2, 2.5, 8}).differs);
  EXPECT_FALSE(audits.take_for(1));
  EXPECT_FALSE(audits.take_for(2));
  ASSERT_TRUE(audits.take_for(3));
  EXPECT_EQ(audits.hear(key, {3, 2.5, 9}).outvoted, 2);
  EXPECT_TRUE(audits.empty());
}

TEST_F(AuditOfOne, FindsThatTheFirstOneWasWrong) {
  audits.take_for(2);
  audits.hear(key, {2, -1, 9});
  audits.take_for(3);
  const Audits::Verdict verdict = audits.hear(key, {3, -1, 9});
  EXPECT_TRUE(verdict.differs);
  EXPECT_EQ(verdict.outvoted, 1);
}

TEST_F(AuditOfOne, BelievesNobodyWhenAllDiffer) {
  audits.take_for(2);
  audits.hear(key, {2, -1, 9});
  audits.take_for(3);
  EXPECT_TRUE(audits.hear(key, {3, -2, 9}).no_two_agree);
}

TEST_F(AuditOfOne, IsGivenUpWhenTooManyWorkersAreLostWithIt) {
  for (WorkerNumber worker = 2; worker < 5; ++worker) {
    EXPECT_EQ(audits.given_up(), 0U);
    ASSERT_TRUE(audits.take_for(worker));
    audits.give_back(key);
  }
  EXPECT_EQ(audits.given_up(), 1U);
  EXPECT_TRUE(audits.empty());
}

TEST(Audits, RememberABoundedNumber) {
  Audits audits;
  for (std::int64_t i = 1; i <= 3000; ++i)
    audits.open({.key = {{i}, Purpose::Race, 1}}, {.worker = 1});
  EXPECT_EQ(audits.waiting(), 1000U);
  EXPECT_EQ(audits.given_up(), 2000U);
}

/// The scheduler with audits of every evaluation.
struct AuditedScheduler : Schedulers {
  AuditedScheduler() {
    SchedulerOptions audited;
    audited.campaigns[0].audit_every = 1;
    audited.quarantine_after = 5;
    scheduler = Scheduler(audited);
  }
  std::vector<std::string> states() {
    std::vector<std::string> states;
    for (const WorkerChanged& changed : all<WorkerChanged>())
      states.push_back(changed.row.state);
    return states;
  }
};

TEST_F(AuditedScheduler, MakesAnEvaluationTwiceAndKeepsTheFirstResult) {
  hello(1), hello(2);
  credit(1, 1);
  want(1, 1);
  answer(1, 1, 3.0);
  EXPECT_TRUE(scheduler.is_auditing());
  credit(2, 1);
  EXPECT_EQ(scheduler.leases().leases_of(2).size(), 1U);
  answer(2, 1, 3.0);
  EXPECT_FALSE(scheduler.is_auditing());
  EXPECT_EQ(scheduler.counters().audited, 1U);
  EXPECT_EQ(scheduler.counters().done, 1U);
  EXPECT_EQ(scheduler.counters().conflicts, 0U);
  EXPECT_EQ(all<OutcomeAccepted>().size(), 1U);
  EXPECT_EQ(all<AttemptEnded>().at(0).row.outcome, "audited");
}

TEST_F(AuditedScheduler, ComparesTheBitsOfADesignThatIsOver) {
  hello(1), hello(2);
  credit(1, 1);
  want(1, 1);
  answer(1, 1, 3.0);
  credit(1, 0);
  credit(2, 1);
  scheduler.close_design(0, {1});
  answer(2, 1, 4.0);
  EXPECT_EQ(scheduler.counters().audited, 1U);
  ASSERT_EQ(all<ConflictFound>().size(), 1U);
  EXPECT_EQ(all<ConflictFound>()[0].row.kept_score, 3.0);
}

TEST_F(AuditedScheduler, DoesNotWaitForASecondWorkerThatIsNotThere) {
  hello(1);
  credit(1, 5);
  want(1, 1);
  answer(1, 1, 3.0);
  EXPECT_FALSE(scheduler.is_auditing());
  EXPECT_EQ(scheduler.leases().size(), 0U);
}

TEST_F(AuditedScheduler, SendsALiarToQuarantineOnTheWordOfTwo) {
  hello(1), hello(2), hello(3);
  credit(1, 1);
  want(1, 1);
  answer(1, 1, 3.0);
  credit(1, 0);
  credit(2, 1);
  answer(2, 1, 99.0);  // the liar
  EXPECT_EQ(scheduler.counters().conflicts, 1U);
  EXPECT_EQ(scheduler.counters().quarantined, 0U);
  credit(2, 0);
  credit(3, 1);
  answer(3, 1, 3.0);
  EXPECT_EQ(scheduler.counters().quarantined, 1U);
  EXPECT_EQ(states().back(), "quarantined");
  // It gets nothing more, what it says is not believed, and it stays there when it comes again.
  credit(3, 0);
  credit(2, 100);
  want(2, 1);
  EXPECT_TRUE(scheduler.leases().leases_of(2).empty());
  answer(2, 2, 7.0);
  EXPECT_EQ(scheduler.counters().done, 1U);
  hello(2, 1, 2);
  EXPECT_EQ(scheduler.workers().trusted(), 2U);
  credit(2, 100, 2);
  EXPECT_TRUE(scheduler.leases().leases_of(2).empty());
}

TEST_F(AuditedScheduler, SaysThatAStoredScoreIsWrong) {
  hello(1), hello(2), hello(3);
  credit(1, 1);
  want(1, 1);
  answer(1, 1, 99.0);  // the liar was first
  credit(1, 0);
  for (const PeerId honest : {2U, 3U}) {
    credit(honest, 1);
    answer(honest, 1, 3.0);
    credit(honest, 0);
  }
  EXPECT_EQ(scheduler.counters().quarantined, 1U);
  std::vector<std::string> kinds;
  for (const Noted& noted : all<Noted>())
    kinds.push_back(noted.row.kind);
  EXPECT_EQ(std::ranges::count(kinds, "a stored score is wrong"), 1);
}

TEST_F(AuditedScheduler, AsksAgainWhenTheAuditorIsLost) {
  hello(1), hello(2), hello(3);
  credit(1, 1);
  want(1, 1);
  answer(1, 1, 3.0);
  credit(1, 0);
  credit(2, 1);
  scheduler.on_unreachable(2, now);
  move();
  credit(3, 1);
  EXPECT_EQ(scheduler.leases().leases_of(3).size(), 1U);
  answer(3, 1, 3.0);
  EXPECT_EQ(scheduler.counters().audited, 1U);
  EXPECT_EQ(scheduler.leases().size(), 0U);
}

TEST_F(Schedulers, QuarantineAWorkerThatFailsWhereOthersSucceed) {
  hello(1), hello(2);
  for (std::int64_t i = 1; i <= 5; ++i) {
    EXPECT_EQ(scheduler.counters().quarantined, 0U);
    credit(1, 1);
    want(i, 1);
    answer(1, i, 0, "the disk is broken");
    credit(1, 0);
    credit(2, 1);
    answer(2, i, 1.0, "", 2);
    credit(2, 0);
  }
  EXPECT_EQ(scheduler.counters().quarantined, 1U);
  EXPECT_EQ(scheduler.counters().done, 5U);
}

TEST_F(Schedulers, DoNotQuarantineForEvaluationsThatFailEverywhere) {
  hello(1), hello(2);
  for (std::int64_t i = 1; i <= 8; ++i) {
    credit(1, 1);
    want(i, 1);
    answer(1, i, 0, "planted");
    credit(1, 0);
    credit(2, 1);
    answer(2, i, 0, "planted", 2);
    credit(2, 0);
  }
  EXPECT_EQ(scheduler.counters().quarantined, 0U);
  EXPECT_EQ(scheduler.counters().rejected, 8U);
}

}  // namespace
}  // namespace swarmsmith
