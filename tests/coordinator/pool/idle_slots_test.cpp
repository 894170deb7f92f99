// Second copies of stragglers, and look-ahead.

#include "tests/coordinator/pool/schedulers.h"

namespace swarmsmith {
namespace {

class IdleSlots : public Schedulers {
 protected:
  void look_ahead(std::int64_t first, std::int64_t count) {
    std::vector<Task> tasks;
    for (std::int64_t i = first; i < first + count; ++i)
      tasks.push_back({{.machine = "m"}, {{i}, Purpose::Race, 1}, 0, true});
    scheduler.add(std::move(tasks));
    move();
  }
  /// Task 1 is out at worker 1 for long, and worker 2 has got a copy.
  void make_straggler() {
    hello(1);
    hello(2);
    credit(1, 2);
    want(1, 1);
    credit(2, 2);
    pass(milliseconds(101));
  }
  const TaskRecord* record(std::int64_t candidate) const {
    return scheduler.leases().find(key(candidate));
  }
};

using Candidates = std::vector<std::int64_t>;

TEST_F(IdleSlots, GetASecondCopyOfAStraggler) {
  hello(1);
  hello(2);
  credit(1, 2);
  want(1, 1);
  credit(2, 2);
  pass(milliseconds(99));
  EXPECT_TRUE(given[2].empty());
  pass(milliseconds(2));
  EXPECT_EQ(given[2], Candidates{1});
  pass(seconds(1));
  EXPECT_EQ(given[1].size() + given[2].size(), 2U) << "there is one extra copy at most";
}

TEST_F(IdleSlots, WaitForAFewTimesTheEstimate) {
  hello(1);
  hello(2);
  credit(1, 2);
  want(1, 1);
  answer(1, {.key = key(1), .attempt = 1, .measured = {.score = 1, .wall_us = 100'000}});
  credit(2, 2);
  credit(1, 2);
  want(2, 1);
  pass(milliseconds(399));
  EXPECT_EQ(scheduler.counters().copies, 0U);
  pass(milliseconds(2));
  EXPECT_EQ(scheduler.counters().copies, 1U);
}

TEST_F(IdleSlots, GetNoCopyOfWhatTheirOwnWorkerHas) {
  hello(1, 2);
  credit(1, 2);
  want(1, 1);
  pass(seconds(1));
  EXPECT_EQ(scheduler.counters().copies, 0U);
}

TEST_F(IdleSlots, AreNotThoseOfABusyWorker) {
  hello(1);
  hello(2);
  credit(1, 2);
  credit(2, 2);
  want(1, 2);
  EXPECT_EQ(scheduler.idle_slots(), 0U);
  pass(seconds(1));
  EXPECT_EQ(scheduler.counters().copies, 0U);
}

TEST_F(IdleSlots, TakeWhicheverCopyComesFirst) {
  make_straggler();
  answer(2, 1, 2.5, "", 2);
  EXPECT_EQ(only<OutcomeAccepted>().outcome.worker, 2);
  EXPECT_EQ(only<OutcomeAccepted>().outcome.attempt, 2);
  EXPECT_EQ(only<AttemptEnded>().row.outcome, AttemptOutcome::SecondCopy);
  EXPECT_EQ(only<AttemptEnded>().row.worker, 1);
  EXPECT_EQ(only<AttemptEnded>().row.held_ms, 101);
  answer(1, 1, 2.5);
  EXPECT_EQ(all<OutcomeAccepted>().size(), 1U);
  EXPECT_EQ(scheduler.counters().duplicates, 1U);
  EXPECT_TRUE(all<ConflictFound>().empty());
}

TEST_F(IdleSlots, CompareTheCopiesBitByBit) {
  make_straggler();
  answer(2, 1, 2.5, "", 2);
  answer(1, 1, 2.6);
  dispute(1);
  EXPECT_EQ(all<ConflictFound>().size(), 1U);
}

TEST_F(IdleSlots, CountTheSlotThatStillRunsTheOtherCopy) {
  make_straggler();
  answer(2, 1, 2.5, "", 2);
  want(2, 3);
  EXPECT_EQ(given[1], Candidates{1}) << "its only slot is busy with what is not needed";
  EXPECT_EQ(given[2], (Candidates{1, 2}));
  answer(1, 1, 2.5);
  EXPECT_EQ(given[1], (Candidates{1, 3}));
}

TEST_F(IdleSlots, ReportTheTasksBehindOneThatIsNotNeeded) {
  hello(1, 2);
  hello(2);
  credit(1, 2);
  want(1, 2);
  credit(2, 2);
  pass(milliseconds(101));
  answer(2, 1, 2.5, "", 2);
  ASSERT_NE(record(2), nullptr);
  ASSERT_TRUE(record(2)->lease);
  now += milliseconds(1);
  beat(1, {{key(1), 102}, {key(2), 102}});
  EXPECT_EQ(record(2)->lease->renewed, now);
}

TEST_F(IdleSlots, DoNotBlameATaskForOneOfItsCopies) {
  make_straggler();
  answer(2, 1, 0, "not a number", 2);
  EXPECT_FALSE(asked());
  EXPECT_EQ(record(1)->lease->worker, 1);
  EXPECT_FALSE(record(1)->second);
  pass(seconds(1));
  EXPECT_EQ(scheduler.counters().copies, 1U) << "and it is not tried there again";
}

TEST_F(IdleSlots, KeepTheCopyWhenTheFirstWorkerDies) {
  make_straggler();
  lose(1);
  ASSERT_NE(record(1), nullptr);
  EXPECT_FALSE(record(1)->alone);
  EXPECT_EQ(record(1)->lease->worker, 2);
  EXPECT_EQ(scheduler.leases().leased(), 1U);
  lose(2);
  EXPECT_TRUE(record(1)->alone) << "the last one had it among the suspects";
}

TEST_F(IdleSlots, CountATimeoutOfBothCopiesOnce) {
  make_straggler();
  beat(1, {{key(1), 31'000}}, 0);
  EXPECT_EQ(record(1)->timeouts, 0);
  beat(2, {{key(1), 31'000}}, 0);
  EXPECT_EQ(record(1)->timeouts, 1);
}

TEST_F(IdleSlots, AreNotCopiedToForPrograms) {
  options.evaluates_programs = true;
  scheduler = Scheduler(options);
  make_straggler();
  pass(seconds(1));
  EXPECT_TRUE(given[2].empty());
  EXPECT_EQ(scheduler.idle_slots(), 0U);
}

TEST_F(IdleSlots, TakeLookAheadAndNoMoreThanTheyAre) {
  hello(1, 2);
  credit(1, 10);
  EXPECT_EQ(scheduler.idle_slots(), 2U);
  look_ahead(1, 5);
  EXPECT_EQ(given[1], (Candidates{1, 2}));
  EXPECT_EQ(scheduler.idle_slots(), 0U);
  want(11, 2);  // urgent ones wait for what runs, not for a queue of look-ahead
  EXPECT_EQ(given[1], (Candidates{1, 2, 11, 12}));
  answer(1, 1);
  EXPECT_EQ(given[1].size(), 4U);
}

TEST_F(IdleSlots, PromoteWhatIsWantedNow) {
  hello(1);
  credit(1, 1);
  look_ahead(1, 3);
  EXPECT_EQ(given[1], Candidates{1});
  want(3, 1);  // queued
  want(1, 1);  // leased
  EXPECT_FALSE(record(1)->task.ahead);
  EXPECT_EQ(scheduler.leases().wanted_leased(), 1U);
  EXPECT_EQ(scheduler.leases().loads().of(1).ahead, 0U);
  answer(1, 1);
  EXPECT_EQ(given[1], (Candidates{1, 3}));
}

TEST_F(IdleSlots, DoNotRepeatWhatWasToldBeforeItWasWanted) {
  hello(1);
  credit(1, 1);
  look_ahead(1, 1);
  answer(1, 1);
  want(1, 1);
  EXPECT_EQ(given[1], Candidates{1});
  EXPECT_EQ(scheduler.leases().size(), 0U);
}

TEST_F(IdleSlots, DropWhatIsNoLongerWanted) {
  hello(1);
  credit(1, 1);
  look_ahead(1, 3);
  const std::vector<PackedKey> keys{key(1), key(2)};
  scheduler.drop(keys);
  EXPECT_EQ(scheduler.leases().size(), 2U) << "what is leased goes on";
  answer(1, 1);
  EXPECT_EQ(given[1], (Candidates{1, 3}));
}

TEST_F(IdleSlots, StopNoCampaignForLookAheadThatFails) {
  options.campaigns[0].stop_on_failure = true;
  scheduler = Scheduler(options);
  hello(1);
  credit(1, 1);
  look_ahead(1, 1);
  answer(1, 1, 0, "not a number", 1);
  rule_rejected(1);
  EXPECT_TRUE(all<StopCampaign>().empty());
  EXPECT_EQ(given[1].size(), 1U) << "it waits until a worker asks for it";
  want(1, 1);
  EXPECT_EQ(given[1].size(), 2U);
  answer(1, 1, 0, "not a number", 2);
  rule_rejected(1);
  EXPECT_EQ(all<StopCampaign>().size(), 1U);
}

}  // namespace
}  // namespace swarmsmith
