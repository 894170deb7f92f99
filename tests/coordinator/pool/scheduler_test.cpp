#include "tests/coordinator/pool/schedulers.h"

namespace swarmsmith {
namespace {

TEST_F(Schedulers, GiveNothingBeyondTheCredit) {
  hello(1);
  want(1, 100);
  EXPECT_TRUE(given[1].empty());
  credit(1, 3);
  EXPECT_EQ(given[1], (std::vector<std::int64_t>{1, 2, 3}));
  credit(1, 3);
  EXPECT_EQ(given[1].size(), 3U);
  answer(1, 1);
  EXPECT_EQ(given[1].size(), 4U);
}

TEST_F(Schedulers, ShareWhatIsLeftNearTheEnd) {
  hello(1);
  hello(2);
  credit(1, 4000);
  credit(2, 4000);
  want(1, 8);
  // Eight left and two slots: two each, the rest waits for who is first.
  EXPECT_EQ(given[1].size(), 2U);
  EXPECT_EQ(given[2].size(), 2U);
}

TEST_F(Schedulers, CloseAMessageAtSixtyFourTasks) {
  hello(1);
  credit(1, 200);
  want(1, 1000);
  const auto messages = all<SendTasks>();
  ASSERT_EQ(messages.size(), 4U);
  EXPECT_EQ(messages[0].tasks.size(), 64U);
  EXPECT_EQ(messages[3].tasks.size(), 8U);
}

TEST_F(Schedulers, CloseALongMessageEarlier) {
  std::vector<Task> calls(100, task_of(0));
  for (std::size_t i = 0; i < calls.size(); ++i) {
    calls[i].key.candidate.value = static_cast<std::int64_t>(i) + 1;
    calls[i].alive.assign(1000, 1);  // 8 bytes for each
  }
  hello(1);
  credit(1, 18);
  scheduler.add(std::move(calls));
  move();
  const auto messages = all<SendTasks>();
  ASSERT_EQ(messages.size(), 2U);
  EXPECT_EQ(messages[0].tasks.size(), 9U);
}

TEST_F(Schedulers, ForgetTheTasksOfACampaign) {
  hello(1);
  give(1, 1, 3);
  scheduler.forget(0);
  EXPECT_EQ(scheduler.leases().size(), 0U);
}

TEST_F(Schedulers, AcceptTheFirstResultAndDropTheSecond) {
  hello(1);
  give(1, 1);
  answer(1, 1, 2.5);
  resend(1, 1, 2.5);
  EXPECT_EQ(only<OutcomeAccepted>().outcome.measured.score, 2.5);
  EXPECT_EQ(all<OutcomeRepeated>().size(), 1U);
  EXPECT_TRUE(all<ConflictFound>().empty());
}

TEST_F(Schedulers, ReportASecondResultWithOtherBits) {
  hello(1);
  give(1, 1);
  answer(1, 1, 2.5);
  resend(1, 1, 2.6);
  dispute(1);
  EXPECT_EQ(only<ConflictFound>().row.kept_score, 2.5);
  EXPECT_EQ(only<ConflictFound>().row.other_score, 2.6);
}

TEST_F(Schedulers, AcknowledgeWhateverComesOfADesignThatIsOver) {
  hello(1);
  give(1, 1, 2);
  answer(1, 1, 2.5);
  scheduler.close_design(0, {1});
  resend(1, 1, 2.6);
  EXPECT_TRUE(all<ConflictFound>().empty()) << "it is not compared any more";
  EXPECT_EQ(all<OutcomeRepeated>().size(), 1U);
  EXPECT_EQ(scheduler.counters().duplicates, 1U);
  EXPECT_EQ(scheduler.counters().unknown, 0U);
  // What was given still gets its outcome.
  answer(1, 2, 3.5);
  resend(1, 2, 3.5);
  EXPECT_EQ(all<OutcomeAccepted>().size(), 2U);
  EXPECT_EQ(scheduler.counters().duplicates, 2U);
}

TEST_F(Schedulers, IgnoreAResultThatIsNotWanted) {
  hello(1);
  answer(1, {.key = key(77),
             .attempt = 1,
             .signature = scheduler.signer().sign(task_of(77), 1, name_of(1))});
  EXPECT_TRUE(all<OutcomeAccepted>().empty());
  EXPECT_TRUE(all<SendAcknowledged>().empty()) << "it may be wanted later";
  EXPECT_EQ(scheduler.counters().unknown, 1U);
}

TEST_F(Schedulers, RefuseAnotherEngine) {
  hello(1, 1, 1, 99);
  EXPECT_EQ(only<SendReject>().reason, RejectReason::Build);
  EXPECT_NE(only<SendReject>().sentence.find("version 99"), std::string::npos);
  EXPECT_EQ(scheduler.workers().connected(), 0U);
}

TEST_F(Schedulers, IgnoreAnOldHello) {
  hello(1, 1, 3);
  hello(21, 1, 2);  // the same worker over another connection
  hello(21, 1, 3);
  hello(1, 1, 2);
  EXPECT_EQ(all<SendWelcome>().size(), 1U);
  hello(1, 1, 3);
  EXPECT_EQ(all<SendWelcome>().size(), 2U) << "the first welcome may have been lost";
}

TEST_F(Schedulers, AskWhoSpeaks) {
  credit(4, 1);
  EXPECT_EQ(all<SendWhoAreYou>().size(), 1U);
}

TEST_F(Schedulers, GiveTheTasksOfASilentWorkerToOthers) {
  hello(1);
  credit(1, 2);
  want(1, 4);
  EXPECT_EQ(given[1].size(), 2U);
  for (int i = 0; i < 6; ++i)
    pass(seconds(1));
  EXPECT_EQ(scheduler.workers().connected(), 0U);
  hello(2);
  credit(2, 100);
  EXPECT_EQ(given[2][0], 1);
}

TEST_F(Schedulers, TryAloneWhatRanWhenAWorkerDied) {
  hello(1);
  hello(2);
  credit(2, 0);
  credit(1, 100);
  want(1, 8);
  const std::size_t before = given[1].size();
  ASSERT_GE(before, 2U);
  scheduler.on_unreachable(1, now + milliseconds(10));
  credit(2, 100);
  EXPECT_EQ(given[2], (std::vector<std::int64_t>{1}));
  answer(2, 1);
  EXPECT_EQ(given[2], (std::vector<std::int64_t>{1, 2}));
}

TEST_F(Schedulers, AskTheRefereeAfterADeathAlone) {
  want(1, 1);
  for (PeerId peer = 1; peer <= 2; ++peer) {
    EXPECT_FALSE(asked());
    hello(peer);
    credit(peer, 10);
    ASSERT_EQ(given[peer].size(), 1U);
    scheduler.on_began({peer, 1, 2}, key(1), now);
    lose(peer);
  }
  EXPECT_TRUE(all<OutcomeAccepted>().empty());
  ASSERT_EQ(asked(), key(1));
  hello(3);
  credit(3, 10);
  EXPECT_TRUE(given[3].empty()) << "no other worker gets it meanwhile";
  rule_rejected(1);
  EXPECT_EQ(only<OutcomeAccepted>().outcome.status, EvaluationStatus::Rejected);
}

TEST_F(Schedulers, TakeTheRefereesScoreWhereAWorkerDiedByAccident) {
  want(1, 1);
  for (PeerId peer = 1; peer <= 2; ++peer) {
    hello(peer);
    credit(peer, 10);
    scheduler.on_began({peer, 1, 2}, key(1), now);
    lose(peer);
  }
  rule_score(1, 4.5);
  EXPECT_EQ(only<OutcomeAccepted>().outcome.measured.score, 4.5);
  EXPECT_EQ(only<OutcomeAccepted>().outcome.worker, 0);
  EXPECT_EQ(scheduler.counters().quarantined, 0U) << "a death is not a lie";
}

TEST_F(Schedulers, CountNoDeathOfAWorkerThatDidNotBegin) {
  want(1, 1);
  for (PeerId peer = 1; peer <= 8; ++peer) {
    hello(peer);
    credit(peer, 10);
    ASSERT_EQ(given[peer].size(), 1U);
    lose(peer);
  }
  EXPECT_FALSE(asked());
  EXPECT_TRUE(all<OutcomeAccepted>().empty());
}

TEST_F(Schedulers, BlameNoWorkerForATaskThatNeverGotToIt) {
  want(1, 1);
  const std::vector<PackedKey> undelivered{key(1)};
  for (PeerId peer = 1; peer <= 20; ++peer) {
    hello(peer);
    credit(peer, 10);
    ASSERT_EQ(given[peer].size(), 1U);
    scheduler.on_unreachable(peer, now, undelivered);
    move();
  }
  EXPECT_TRUE(all<OutcomeAccepted>().empty());
}

TEST_F(Schedulers, TakeBackADeathWhenTheWorkerComesAgain) {
  want(1, 1);
  hello(1);
  credit(1, 10);
  std::uint64_t incarnation = 1;
  for (int i = 0; i < 10; ++i) {
    lose(1);
    hello(1, 1, ++incarnation);
    credit(1, 10, incarnation);
  }
  EXPECT_TRUE(all<OutcomeAccepted>().empty());
  EXPECT_EQ(given[1].size(), 11U);
}

TEST_F(Schedulers, BringAFailureBeforeTheReferee) {
  hello(1);
  credit(1, 10);
  want(1, 1);
  answer(1, 1, 0, "not a number");
  EXPECT_EQ(scheduler.counters().failed, 1U);
  EXPECT_TRUE(all<OutcomeAccepted>().empty());
  ASSERT_EQ(asked(), key(1));
  answer(1, 1, 0, "not a number");  // said twice
  rule_rejected(1);
  EXPECT_EQ(only<OutcomeAccepted>().outcome.status, EvaluationStatus::Rejected);
  EXPECT_FALSE(asked());
}

TEST_F(Schedulers, BringATimeoutBeforeTheRefereeAfterTheRetries) {
  hello(1);
  credit(1, 10);
  want(1, 1);
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(asked());
    beat(1, {{key(1), 31'000}});
  }
  ASSERT_EQ(asked(), key(1));
  EXPECT_TRUE(all<StopCampaign>().empty());
  rule({.key = key(1), .kind = Ruling::Kind::TimedOut, .reason = "took longer"});
  EXPECT_FALSE(only<StopCampaign>().distrusted);
  EXPECT_TRUE(all<OutcomeAccepted>().empty());
}

TEST_F(Schedulers, LetALeaseExpireThatMakesNoProgress) {
  hello(1);
  hello(2);
  give(1, 1, 2);
  EXPECT_EQ(given[1].size(), 1U);
  for (int i = 0; i < 7; ++i) {
    beat(1, {{key(1), i * 1000}}, 2);
    beat(2, {}, 0);
    pass(seconds(1));
  }
  EXPECT_EQ(scheduler.counters().expired, 0U);  // it says that it runs
  for (int i = 0; i < 7; ++i) {
    beat(1, {}, 2);
    beat(2, {}, 0);
    pass(seconds(1));
  }
  EXPECT_GE(scheduler.counters().expired, 1U);
}

TEST_F(Schedulers, KnowThatTheyWereStoppedThemselves) {
  hello(1);
  pass(milliseconds(100));
  pass(seconds(60));
  EXPECT_EQ(scheduler.workers().connected(), 1U);
}

TEST_F(Schedulers, KeepWhatAReturningWorkerHolds) {
  hello(1);
  credit(1, 2);
  want(1, 40);
  EXPECT_EQ(given[1], (std::vector<std::int64_t>{1, 2}));
  hello(1, 1, 2, 0, {key(2)});
  EXPECT_EQ(scheduler.leases().leased(), 1U);
  ASSERT_TRUE(scheduler.leases().find(key(2))->lease);
  EXPECT_EQ(scheduler.leases().find(key(2))->lease->attempt, 1) << "the lease that it had";
  credit(1, 2, 2);
  EXPECT_EQ(given[1].back(), 1);
}

TEST_F(Schedulers, RequeueWhatADrainingWorkerReturns) {
  hello(1);
  credit(1, 2);
  want(1, 40);
  const std::vector<PackedKey> keys{key(1), key(2)};
  scheduler.on_returned({1, 1, ++sequence}, keys, now);
  move();
  EXPECT_EQ(scheduler.leases().leased(), 0U);  // it wants none any more
  hello(2);
  credit(2, 1);
  EXPECT_EQ(given[2], (std::vector<std::int64_t>{1}));
}

TEST_F(Schedulers, LeaseNothingWhileHeld) {
  hello(1);
  credit(1, 10);
  scheduler.hold(true);
  want(1, 10);
  EXPECT_TRUE(given[1].empty());
  scheduler.hold(false);
  move();
  EXPECT_FALSE(given[1].empty());
}

TEST_F(Schedulers, LeaseNothingOfADesignThatIsHeld) {
  const auto first_of = [](std::int64_t design) { return (design - 1) * kMostCandidates + 1; };
  hello(1);
  credit(1, 4);
  scheduler.hold_design(0, 1, true);
  want(first_of(1), 2);
  want(first_of(2), 2);
  EXPECT_EQ(given[1], (std::vector<std::int64_t>{first_of(2), first_of(2) + 1}));
  answer(1, first_of(2));
  answer(1, first_of(2) + 1);
  scheduler.hold_design(0, 0, true);
  scheduler.hold_design(0, 1, false);
  move();
  EXPECT_EQ(given[1].size(), 2U);  // the whole campaign is held now
  scheduler.hold_design(0, 0, false);
  move();
  EXPECT_EQ(given[1].size(), 4U);
}

TEST_F(Schedulers, AreFullAtTheLimit) {
  SchedulerOptions small;
  small.max_workers = 1;
  scheduler = Scheduler(small);
  hello(1);
  hello(2);
  EXPECT_EQ(only<SendReject>().reason, RejectReason::Limit);
}

TEST_F(Schedulers, AreFullForOneAddressAtItsLimit) {
  options.max_workers_of_one = 1;
  scheduler = Scheduler(options);
  enter(1, "10.0.0.1");
  enter(2, "10.0.0.2");
  enter(1, "10.0.0.1", 1, 2);
  EXPECT_TRUE(all<SendReject>().empty()) << "a known worker may come again";
  enter(3, "10.0.0.1");
  EXPECT_EQ(only<SendReject>().reason, RejectReason::Limit);
}

TEST_F(Schedulers, ForgetAWorkerThatLeftLongAgo) {
  hello(1);
  lose(1);
  pass(WorkerRegistry::kMemory);
  EXPECT_EQ(scheduler.workers().all().size(), 1U);
  pass(std::chrono::minutes(2));
  EXPECT_TRUE(scheduler.workers().all().empty());
}

}  // namespace
}  // namespace swarmsmith
