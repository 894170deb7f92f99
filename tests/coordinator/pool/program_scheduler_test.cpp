// The scheduler's rules for evaluations by programs: they may take hours, cost what they cost, and
// need not say the same twice.

#include "tests/coordinator/pool/schedulers.h"

namespace swarmsmith {
namespace {

class ProgramSchedulers : public Schedulers {
 protected:
  void SetUp() override {
    options.evaluates_programs = true;
    options.campaigns[0].task_timeout = seconds(30);
    scheduler = Scheduler(options);
  }
  /// As time passes for a worker that is alive.
  void run_for(PeerId peer, Duration time, std::vector<std::int64_t> candidates) {
    const TimePoint until = now + time;
    while (now < until) {
      std::vector<RunningReport> reports;
      for (const std::int64_t candidate : candidates)
        reports.push_back({key(candidate), 100'000'000});
      beat(peer, reports);
      pass(seconds(1));
    }
  }
  /// Of two campaigns the first one stops when an evaluation fails.
  void use_two_campaigns() {
    options.campaigns.resize(2);
    options.campaigns[0].stop_on_failure = true;
    scheduler = Scheduler(options);
  }
  /// The first campaign's tasks are forgotten, and the second one has tasks 3 and 4.
  void go_on_with_the_second() {
    scheduler.forget(0);
    std::vector<Task> others{task_of(3), task_of(4)};
    for (Task& task : others)
      task.campaign = 1;
    scheduler.add(std::move(others));
    move();
  }
  static Result failed(std::int64_t candidate, std::int64_t attempt = 1) {
    return {.key = key(candidate),
            .attempt = attempt,
            .failure = "it printed apples",
            .details = {"runner 1 2", "apples", "no tree"}};
  }
};

TEST_F(ProgramSchedulers, LeaseWhatAWorkerCanRun) {
  hello(1, 4);
  credit(1, 100);
  want(1, 20);
  EXPECT_EQ(given[1].size(), 4U);
}

TEST_F(ProgramSchedulers, LeaseOneMoreASlotWhenProgramsAreShort) {
  hello(1, 4);
  credit(1, 100);
  want(1, 40);
  answer(1, {.key = key(1), .attempt = 1, .measured = {.score = 1, .wall_us = 3000}});
  EXPECT_EQ(given[1].size(), 9U);
  // And no longer when they are not.
  for (std::int64_t i = 2; i <= 9; ++i)
    answer(1, {.key = key(i), .attempt = 1, .measured = {.score = 1, .wall_us = 3'600'000'000}});
  EXPECT_EQ(scheduler.leases().leased(), 4U);
}

TEST_F(ProgramSchedulers, NeverLeaseTwiceWhileTheWorkerRuns) {
  hello(1, 1);
  hello(2, 1);
  credit(1, 4);
  want(1, 1);
  credit(2, 4);
  for (int i = 0; i < 200; ++i) {
    beat(2);
    run_for(1, seconds(1), {1});
  }
  EXPECT_EQ(given[1].size(), 1U);
  EXPECT_TRUE(given[2].empty());
  EXPECT_TRUE(all<StopCampaign>().empty());
}

TEST_F(ProgramSchedulers, LeaveWhatWaitsBehindALongProgram) {
  hello(1, 1);
  give(1, 1, 4);
  answer(1, {.key = key(1), .attempt = 1, .measured = {.score = 1, .wall_us = 3000}});
  ASSERT_EQ(given[1], (std::vector<std::int64_t>{1, 2, 3}));
  hello(2, 1);
  run_for(1, seconds(100), {2});  // and 3 waits
  EXPECT_EQ(given[1], (std::vector<std::int64_t>{1, 2, 3}));
  EXPECT_EQ(scheduler.leases().queued(), 1U);
}

TEST_F(ProgramSchedulers, LeaseAgainWhatNeverCame) {
  hello(1, 2);
  credit(1, 4);
  want(1, 2);
  run_for(1, seconds(28), {1});
  EXPECT_EQ(given[1].size(), 2U);
  run_for(1, seconds(5), {1});
  EXPECT_EQ(given[1], (std::vector<std::int64_t>{1, 2, 2}));
}

TEST_F(ProgramSchedulers, RunAgainWhatALostWorkerHad) {
  hello(1, 2);
  credit(1, 4);
  want(1, 2);
  scheduler.on_unreachable(1, now);
  hello(2, 2);
  credit(2, 4);
  // At once and together: programs do not kill their workers.
  EXPECT_EQ(given[2].size(), 2U);
  scheduler.on_unreachable(2, now);
  hello(3, 2);
  credit(3, 4);
  EXPECT_EQ(given[3].size(), 1U);  // twice is not an accident any more
}

TEST_F(ProgramSchedulers, RejectWhatFailedOnce) {
  hello(1);
  give(1, 1);
  answer(1, failed(1));
  EXPECT_EQ(only<OutcomeAccepted>().outcome.status, EvaluationStatus::Rejected);
  const FailureRow row = only<FailureKept>().row;
  EXPECT_EQ(row.key, unpack(key(1)));
  EXPECT_EQ(row.reason, "it printed apples");
  EXPECT_EQ(row.command, "runner 1 2");
  EXPECT_EQ(row.output, "apples");
  EXPECT_EQ(row.errors, "no tree");
  EXPECT_EQ(row.attempt, 1);
  EXPECT_EQ(row.worker, 1);
}

TEST_F(ProgramSchedulers, StopWithTheWholeStoryWhereTheyMustNotReject) {
  options.campaigns[0].stop_on_failure = true;
  scheduler = Scheduler(options);
  hello(1);
  give(1, 1);
  answer(1, failed(1));
  EXPECT_TRUE(all<OutcomeAccepted>().empty());
  EXPECT_EQ(all<FailureKept>().size(), 1U);
  const std::string reason = only<StopCampaign>().reason;
  for (const char* part :
       {"it printed apples", "runner 1 2", "apples\n", "no tree\n", "by hand", "table `failure`"}) {
    EXPECT_NE(reason.find(part), std::string::npos) << reason;
  }
}

/// Two campaigns share a worker that has only reported on the first one's tasks when that one
/// stops.
TEST_F(ProgramSchedulers, GiveTheSlotsOfAStoppedCampaignToAnotherAtOnce) {
  use_two_campaigns();
  hello(1, 2);
  credit(1, 4);
  want(1, 2);
  ASSERT_EQ(given[1], (std::vector<std::int64_t>{1, 2}));
  const std::vector<Result> both{
      failed(1), {.key = key(2), .attempt = 1, .measured = {.score = 1, .wall_us = 3'000'000}}};
  scheduler.on_results({1, 1, 0}, both, now);
  take();
  ASSERT_EQ(all<StopCampaign>().size(), 1U);
  go_on_with_the_second();
  EXPECT_EQ(given[1], (std::vector<std::int64_t>{1, 2, 3, 4}));
}

/// The second worker's program still runs.
TEST_F(ProgramSchedulers, KeepTheSlotsOfAStoppedCampaignWhoseProgramsRun) {
  use_two_campaigns();
  hello(1, 1);
  hello(2, 1);
  credit(1, 4);
  credit(2, 4);
  want(1, 2);
  ASSERT_EQ(given[2].size(), 1U);
  answer(1, failed(given[1].front()));
  go_on_with_the_second();
  EXPECT_EQ(given[1].size(), 2U);
  EXPECT_EQ(given[2].size(), 1U);
}

TEST_F(ProgramSchedulers, TakeTheFirstOfTwoResults) {
  hello(1);
  give(1, 1);
  answer(1, 1, 2.5);
  resend(1, 1, 2.6);
  EXPECT_EQ(all<OutcomeAccepted>()[0].outcome.measured.score, 2.5);
  EXPECT_EQ(all<OutcomeRepeated>().size(), 1U);
  EXPECT_TRUE(all<ConflictFound>().empty());
}

TEST_F(ProgramSchedulers, TakeARejectionAndItsTime) {
  hello(1);
  give(1, 1);
  answer(1, {.key = key(1), .attempt = 1, .measured = {.score = 9, .time = 3}, .rejected = true});
  EXPECT_EQ(only<OutcomeAccepted>().outcome.measured.score, 0) << "a rejection has no score";
  EXPECT_EQ(only<OutcomeAccepted>().outcome.status, EvaluationStatus::Rejected);
  EXPECT_EQ(only<OutcomeAccepted>().outcome.measured.time, 3);
  EXPECT_TRUE(all<FailureKept>().empty());
}

TEST_F(Schedulers, KeepEveryFailureOfTheSimulatorToo) {
  hello(1);
  give(1, 1);
  answer(1, 1, 0, "no luck");
  rule_rejected(1);
  ASSERT_EQ(all<FailureKept>().size(), 2U);
  EXPECT_EQ(all<FailureKept>()[0].row.worker, 1);
  EXPECT_EQ(all<FailureKept>()[1].row.reason, "not a number");
  EXPECT_EQ(all<FailureKept>()[1].row.worker, 0) << "the referee is not a worker";
}

}  // namespace
}  // namespace swarmsmith
