// Who may answer for an evaluation, and whose word counts how much.

#include <algorithm>

#include "tests/coordinator/pool/schedulers.h"

namespace swarmsmith {
namespace {

class Authority : public Schedulers {
 protected:
  std::vector<std::string> kinds() const {
    std::vector<std::string> kinds;
    for (const Noted& noted : all<Noted>())
      kinds.push_back(noted.row.kind);
    return kinds;
  }
  Result signed_result(std::int64_t candidate, const std::string& principal,
                       std::int64_t attempt = 1) const {
    return {.key = key(candidate),
            .attempt = attempt,
            .measured = {.score = 1, .state_digest = 5, .wall_us = 100},
            .signature = scheduler.signer().sign(task_of(candidate), attempt, principal)};
  }
};

// --- a result needs its lease ---

TEST_F(Authority, RefusesAResultThatWasNeverLeased) {
  hello(1);
  want(1, 1);
  answer(1, 1, 99);
  EXPECT_TRUE(all<OutcomeAccepted>().empty());
  EXPECT_EQ(scheduler.counters().unleased, 1U);
  EXPECT_EQ(all<SendAcknowledged>().size(), 1U) << "it need not be sent again";
}

TEST_F(Authority, RefusesAResultOfAnotherWorkersLease) {
  hello(1), hello(2);
  give(1, 1);
  answer(2, 1, 99);
  answer(2, 1, 0, "because");
  answer(2, {.key = key(1), .attempt = 1, .rejected = true});
  EXPECT_TRUE(all<OutcomeAccepted>().empty());
  EXPECT_FALSE(asked());
  EXPECT_EQ(scheduler.counters().unleased, 3U);
  EXPECT_EQ(scheduler.counters().failed, 0U);
}

TEST_F(Authority, ComparesNothingThatWasNeverLeased) {
  hello(1), hello(2);
  give(1, 1);
  answer(1, 1, 2.5);
  answer(2, 1, 99);
  EXPECT_TRUE(all<ConflictFound>().empty());
  EXPECT_EQ(scheduler.counters().conflicts, 0U);
  EXPECT_EQ(scheduler.counters().duplicates, 0U);
}

TEST_F(Authority, TakesAResultWhoseLeaseHasExpired) {
  hello(1), hello(2);
  give(1, 1);
  const std::uint64_t signature = give_back(1, 1);
  credit(2, 1);
  ASSERT_EQ(given[2].size(), 1U);
  answer(1, {.key = key(1), .attempt = 1, .measured = {.score = 2.5}, .signature = signature});
  EXPECT_EQ(only<OutcomeAccepted>().outcome.worker, 1);
}

TEST_F(Authority, TakesALeaseOfAProcessThatCrashed) {
  // The same secret, and nothing else that is known.
  hello(1);
  want(1, 2);
  answer(1, signed_result(1, name_of(1), 7));
  EXPECT_EQ(all<OutcomeAccepted>().size(), 1U);
  EXPECT_EQ(scheduler.counters().unleased, 0U);
}

TEST_F(Authority, RefusesALeaseOfAnotherTaskUnderTheSameKey) {
  // A crash took a lie away, and with it why another machine had this key.
  Task other = task_of(1);
  other.machine = "another";
  hello(1);
  want(1, 1);
  Result result = signed_result(1, name_of(1), 7);
  result.signature = scheduler.signer().sign(other, 7, name_of(1));
  answer(1, result);
  EXPECT_TRUE(all<OutcomeAccepted>().empty());
  EXPECT_EQ(scheduler.counters().unleased, 1U);
  // The same, when the outcome is there.
  credit(1, 1);
  answer(1, 1, 3);
  ASSERT_EQ(all<OutcomeAccepted>().size(), 1U);
  result.measured.score = 99;
  answer(1, result);
  dispute(1);
  EXPECT_TRUE(all<ConflictFound>().empty());
  EXPECT_EQ(scheduler.counters().unleased, 2U);
}

TEST_F(Authority, AsksForADisputedResultAgainUntilTheRaceTellsTheTask) {
  hello(1);
  give(1, 1);
  answer(1, 1, 3);
  resend(1, 1, 4);
  const std::size_t acknowledged = all<OutcomeRepeated>().size();
  scheduler.on_disputed(key(1), std::nullopt, now);
  move();
  EXPECT_TRUE(all<ConflictFound>().empty());
  EXPECT_EQ(all<OutcomeRepeated>().size(), acknowledged);
  resend(1, 1, 4);
  scheduler.forget(1);  // another campaign
  dispute(1);
  EXPECT_EQ(all<ConflictFound>().size(), 1U);
  EXPECT_EQ(all<OutcomeRepeated>().size(), acknowledged + 1);
}

TEST_F(Authority, AcknowledgesADisputedResultOfACampaignThatIsOver) {
  hello(1);
  give(1, 1);
  answer(1, 1, 3);
  scheduler.close(0, true);
  resend(1, 1, 4);
  scheduler.on_disputed(key(1), std::nullopt, now);
  move();
  EXPECT_EQ(all<OutcomeRepeated>().size(), 1U);
  EXPECT_TRUE(all<ConflictFound>().empty());
}

TEST_F(Authority, RefusesALeaseThatIsNotTheSenders) {
  hello(1), hello(2);
  want(1, 2);
  answer(2, signed_result(1, name_of(1)));
  Result other_attempt = signed_result(1, name_of(2));
  other_attempt.attempt = 2;
  answer(2, other_attempt);
  Result other_key = signed_result(1, name_of(2));
  other_key.key = key(2);
  answer(2, other_key);
  EXPECT_TRUE(all<OutcomeAccepted>().empty());
  EXPECT_EQ(scheduler.counters().unleased, 3U);
}

TEST_F(Authority, AdoptsOnlyWhatWasGiven) {
  want(1, 2);
  WorkerHello claimed;
  claimed.identity = std::string(16, 'x');
  claimed.incarnation = 1;
  claimed.local = true;
  claimed.same_scenario = true;
  const std::uint64_t others = scheduler.signer().sign(task_of(2), 1, "another principal");
  claimed.holds = {{key(1), 1, 0}, {key(2), 1, 12345}, {key(2), 1, others}};
  scheduler.on_hello(9, claimed, now);
  move();
  EXPECT_EQ(scheduler.leases().leased(), 0U);
  hello(1, 1, 1, 0, {key(2)});
  EXPECT_EQ(scheduler.leases().leased(), 1U);
}

TEST_F(Authority, KeepsTheIdsOfPrincipalsApart) {
  enter(1, "10.0.0.1");
  // The same id, and a later incarnation, from elsewhere.
  WorkerHello thief;
  thief.identity = std::string(15, 's') + static_cast<char>('a' + 1);
  thief.incarnation = 9;
  thief.address = "10.0.0.2";
  scheduler.on_hello(2, thief, now);
  take();
  EXPECT_EQ(scheduler.workers().connected(), 2U);
}

// --- newcomers ---

TEST_F(Authority, HoldsBackWhatANewcomerSaysUntilTheRefereeAgrees) {
  enter(1, "10.0.0.1", 4);
  give(1, 1, 4);
  ASSERT_EQ(given[1].size(), 4U);
  for (std::int64_t i = 1; i <= 4; ++i)
    answer(1, i);
  EXPECT_TRUE(all<OutcomeAccepted>().empty());
  rule_score(1);
  EXPECT_EQ(all<OutcomeAccepted>().size(), 1U);
  rule_score(2);
  EXPECT_EQ(all<OutcomeAccepted>().size(), 4U) << "it is known now";
  EXPECT_EQ(all<OutcomeAccepted>()[3].outcome.worker, 1);
}

TEST_F(Authority, TriesAResultThatCameTwiceOnce) {
  enter(1, "10.0.0.1", 4);
  give(1, 1, 4);
  const std::uint64_t signature = scheduler.signer().sign(task_of(1), 1, "10.0.0.1");
  for (int times = 0; times < 2; ++times)
    answer(1, {.key = key(1),
               .attempt = 1,
               .measured = {.score = 1, .state_digest = 5, .wall_us = 100},
               .signature = signature});
  for (std::int64_t i = 2; i <= 4; ++i)
    answer(1, i);
  rule_score(1);
  EXPECT_EQ(all<OutcomeAccepted>().size(), 1U) << "one evaluation does not prove the worker";
  EXPECT_EQ(asked(), key(2));
}

TEST_F(Authority, TriesNoResultThatAnotherWorkerGaveMeanwhile) {
  hello(2);
  enter(1, "10.0.0.1", 4);
  credit(1, 3);
  want(1, 100);
  const std::uint64_t signature = give_back(1, 3);
  credit(2, 1);
  ASSERT_EQ(given[2], std::vector<std::int64_t>{3});
  answer(1, 1), answer(1, 2);
  answer(1, {.key = key(3), .attempt = 1, .measured = {.score = 1}, .signature = signature});
  answer(2, 3);
  EXPECT_EQ(only<OutcomeAccepted>().outcome.worker, 1);
  rule({.key = key(1), .kind = Ruling::Kind::TimedOut});
  EXPECT_EQ(asked(), key(2));
}

TEST_F(Authority, DropsEverythingThatALiarSaidWhenItsFirstWordIsWrong) {
  hello(2);
  enter(1, "10.0.0.1", 4);
  give(1, 1, 4);
  for (const std::int64_t i : given[1])
    answer(1, i, 99);
  const auto lies = static_cast<std::int64_t>(given[1].size());
  ASSERT_GE(lies, 2);
  rule_score(given[1][0]);
  EXPECT_EQ(scheduler.counters().quarantined, 1U);
  EXPECT_TRUE(all<StopCampaign>().empty()) << "nothing of it counts";
  // The referee's own score is the outcome of what it made again, and others make the rest.
  EXPECT_EQ(all<OutcomeAccepted>().size(), 1U);
  EXPECT_EQ(all<OutcomeAccepted>()[0].outcome.measured.score, 1);
  if (asked()) rule_score(given[1][1]);
  for (int i = 0; i < 4; ++i)
    credit(2, 4);
  for (const std::int64_t i : given[2])
    answer(2, i);
  for (const OutcomeAccepted& accepted : all<OutcomeAccepted>())
    EXPECT_EQ(accepted.outcome.measured.score, 1);
}

TEST_F(Authority, StopsTheCampaignWhenAWorkerThatWasBelievedLies) {
  audit_every(1);
  enter(1, "10.0.0.1");
  prove(1, 1);
  give(1, 10);
  answer(1, 10, 99);
  ASSERT_EQ(all<OutcomeAccepted>().size(), 3U);
  ASSERT_EQ(asked(), key(10));
  rule_score(10);
  EXPECT_TRUE(only<StopCampaign>().distrusted);
  const std::string reason = only<StopCampaign>().reason;
  for (const char* part : {"10.0.0.1", "99", "1 result of", "--without-key \"10.0.0.1\""})
    EXPECT_NE(reason.find(part), std::string::npos) << reason;
  EXPECT_EQ(std::ranges::count(kinds(), "a stored score is wrong"), 1);
}

TEST_F(Authority, GoesOnWhenTheRefereeFindsTheSameBits) {
  audit_every(1);
  hello(1);
  give(1, 1);
  answer(1, 1, 3);
  EXPECT_TRUE(scheduler.is_auditing());
  rule_score(1, 3);
  EXPECT_FALSE(scheduler.is_auditing());
  EXPECT_EQ(scheduler.counters().audited, 1U);
  EXPECT_EQ(scheduler.counters().conflicts, 0U);
  EXPECT_EQ(all<OutcomeAccepted>().size(), 1U);
}

TEST_F(Authority, RemembersWhatWasMadeAgain) {
  audit_every(1);
  hello(1);
  give(1, 1, 2);
  answer(1, 1, 3), answer(1, 2, 4);
  rule({.key = key(1), .measured = {.score = 3, .state_digest = 5, .wall_us = 7'654'321}});
  const auto ended = all<AttemptEnded>();
  ASSERT_EQ(ended.size(), 1U);
  EXPECT_EQ(ended[0].row.outcome, AttemptOutcome::Audited);
  EXPECT_EQ(ended[0].row.held_ms, 7654);
  EXPECT_EQ(ended[0].row.worker, 0);
  EXPECT_EQ(ended[0].row.attempt, 1);
  EXPECT_EQ(pack(ended[0].row.key, 0), key(1));
}

TEST_F(Authority, MakesAgainWhatAProcessThatCrashedHadChosen) {
  audit_every(1);
  const auto stored = [](std::int64_t candidate, std::int64_t worker) {
    return StoredScore{.key = unpack(key(candidate)),
                       .measured = {.score = 99, .state_digest = 5},
                       .worker = worker};
  };
  const std::vector<StoredScore> known{stored(1, 1), stored(2, 1), stored(3, 2)};
  // The second one was made again, and whose the third one is is not known.
  const std::deque<StoredWord> words =
      scheduler.know(0, known, {.principals = {{1, "10.0.0.1"}}, .audited = {unpack(key(2))}});
  ASSERT_EQ(words.size(), 1U);
  EXPECT_EQ(pack(words[0].key, 0), key(1));
  scheduler.audit_stored({{.machine = "m"}, words[0].key}, words[0].said);
  move();
  EXPECT_TRUE(scheduler.is_auditing());
  ASSERT_EQ(asked(), key(1));
  rule_score(1, 3);
  EXPECT_TRUE(only<StopCampaign>().distrusted);
}

TEST_F(Authority, MakesNothingAgainWithoutAudits) {
  audit_every(0);
  enter(1, "10.0.0.1");
  give(1, 1);
  answer(1, 1, 3);
  EXPECT_EQ(all<OutcomeAccepted>().size(), 1U);
  EXPECT_FALSE(asked());
  const std::vector<StoredScore> known{{.key = unpack(key(1)), .worker = 1}};
  EXPECT_TRUE(scheduler.know(0, known, {.principals = {{1, "10.0.0.1"}}, .audited = {}}).empty());
}

TEST_F(Authority, MakesTheFirstResultsAgainMoreOften) {
  audit_every(1'000'000);
  enter(1, "10.0.0.1");
  prove(1, 1);
  std::size_t audited = ruled;
  for (std::int64_t i = 10; i < 210; ++i) {
    give(1, i);
    answer(1, i);
    if (asked()) rule_score(i);
    credit(1, 0);
  }
  // The sum of 4/n from n = 3 is 15.6.
  EXPECT_GT(ruled - audited, 5U);
  EXPECT_LT(ruled - audited, 40U);
}

// --- no worker's word rejects an evaluation of the simulator ---

TEST_F(Authority, BringsARejectionBeforeTheReferee) {
  hello(1);
  give(1, 1);
  answer(1, {.key = key(1), .attempt = 1, .rejected = true});
  EXPECT_TRUE(all<OutcomeAccepted>().empty());
  ASSERT_EQ(asked(), key(1));
  rule_score(1, 2);
  EXPECT_EQ(only<OutcomeAccepted>().outcome.status, EvaluationStatus::Ok);
}

TEST_F(Authority, QuarantinesWhoClaimsFailuresThatAreNone) {
  enter(1, "10.0.0.1");
  for (std::int64_t i = 1; i <= 5; ++i) {
    EXPECT_EQ(scheduler.counters().quarantined, 0U);
    give(1, i);
    answer(1, {.key = key(i), .attempt = 1, .rejected = true});
    ASSERT_EQ(asked(), key(i));
    rule_score(i);
    credit(1, 0);
  }
  EXPECT_EQ(scheduler.counters().quarantined, 1U);
  EXPECT_EQ(scheduler.counters().done, 5U);
  EXPECT_EQ(scheduler.counters().rejected, 0U);
}

TEST_F(Authority, DoesNotQuarantineForEvaluationsThatFailEverywhere) {
  hello(1);
  for (std::int64_t i = 1; i <= 8; ++i) {
    give(1, i);
    answer(1, i, 0, "planted");
    rule_rejected(i);
    credit(1, 0);
  }
  EXPECT_EQ(scheduler.counters().quarantined, 0U);
  EXPECT_EQ(scheduler.counters().rejected, 8U);
}

TEST_F(Authority, GivesNothingMoreToWhoHasManyClaimsPending) {
  hello(1, 20);
  enter(2, "10.0.0.1", 20);
  credit(2, 100);
  want(1, 40);
  ASSERT_GE(given[2].size(), 10U);
  for (std::size_t i = 0; i < given[2].size(); ++i)
    answer(2, given[2][i], 0, "because");
  EXPECT_EQ(scheduler.cases().size(), 8U);
  EXPECT_EQ(scheduler.leases().leases_of(2).size(), 0U);
  credit(1, 100);
  EXPECT_GE(given[1].size(), 20U) << "what was over goes to others";
}

TEST_F(Authority, GivesNothingMoreToWhoDisputesManyKnownResults) {
  hello(1, 20);
  credit(1, 100);
  want(1, Principal::kMostClaims);
  for (std::int64_t candidate = 1; candidate <= Principal::kMostClaims; ++candidate)
    answer(1, candidate);
  ASSERT_EQ(all<OutcomeAccepted>().size(), static_cast<std::size_t>(Principal::kMostClaims));
  for (std::int64_t candidate = 1; candidate < Principal::kMostClaims; ++candidate)
    resend(1, candidate, 2);
  want(100, 1);
  EXPECT_EQ(given[1].back(), 100) << "one below the limit";
  answer(1, 100);
  resend(1, Principal::kMostClaims, 2);
  EXPECT_EQ(all<TaskInDispute>().size(), static_cast<std::size_t>(Principal::kMostClaims));
  want(101, 5);
  EXPECT_EQ(given[1].back(), 100);
  resend(1, 100, 2);
  EXPECT_EQ(all<TaskInDispute>().size(), static_cast<std::size_t>(Principal::kMostClaims))
      << "no further dispute";
}

/// Its claims would keep the worker from tasks of other campaigns for ever.
TEST_F(Authority, DisputesOfACampaignThatIsOverAreNoClaims) {
  const auto claims = [&] { return scheduler.principals().all().at(name_of(1)).claims; };
  hello(1);
  give(1, 1);
  answer(1, 1, 3);
  resend(1, 1, 4);
  EXPECT_EQ(claims(), 1);
  scheduler.forget(1);  // another campaign
  EXPECT_EQ(claims(), 1);
  scheduler.forget(0);
  EXPECT_EQ(claims(), 0);
}

TEST_F(Authority, DisputesOfACampaignThatWasStoppedAreNoClaims) {
  hello(1);
  give(1, 1, 2);
  answer(1, 1, 3);
  resend(1, 1, 4);
  answer(1, 2, 0, "not a number");
  rule({.key = key(2), .kind = Ruling::Kind::NoWord, .reason = "no memory"});
  ASSERT_EQ(all<StopCampaign>().size(), 1U);
  scheduler.on_disputed(key(1), task_of(1), now);
  EXPECT_EQ(scheduler.principals().all().at(name_of(1)).claims, 0);
}

TEST_F(Authority, StopsWhereTheRefereeCannotSay) {
  hello(1);
  give(1, 1);
  answer(1, 1, 0, "not a number");
  rule({.key = key(1), .kind = Ruling::Kind::NoWord, .reason = "no memory"});
  EXPECT_NE(only<StopCampaign>().reason.find("no memory"), std::string::npos);
  EXPECT_TRUE(all<OutcomeAccepted>().empty());
}

// --- trust is by key and address ---

TEST_F(Authority, KeepsALiarInQuarantineUnderEveryId) {
  enter(1, "10.0.0.1", 1, 1, "node");
  give(1, 1);
  answer(1, 1, 99);
  rule_score(1);
  ASSERT_EQ(scheduler.counters().quarantined, 1U);
  for (PeerId peer = 2; peer < 6; ++peer)
    enter(peer, "10.0.0.1", 1, 1, "node");
  EXPECT_EQ(scheduler.workers().trusted(), 0U);
  EXPECT_EQ(all<SendReject>().size(), 4U);
  enter(7, "10.0.0.2", 1, 1, "node");
  EXPECT_EQ(scheduler.workers().trusted(), 1U);
}

TEST_F(Authority, RemembersWhoWasInQuarantineBefore) {
  options.quarantined = {
      {.principal = "node@10.0.0.1", .since = "2026-01-02", .reason = "it lied"}};
  scheduler = Scheduler(options);
  enter(1, "10.0.0.1", 1, 1, "node");
  EXPECT_EQ(scheduler.workers().connected(), 0U);
  const std::string sentence = all<SendReject>().at(0).sentence;
  for (const char* part : {"since 2026-01-02", "it lied", "forgive STORE \"node@10.0.0.1\""})
    EXPECT_NE(sentence.find(part), std::string::npos) << sentence;
  enter(2, "10.0.0.2", 1, 1, "node");
  EXPECT_EQ(scheduler.workers().connected(), 1U);
}

TEST_F(Authority, BelievesAKeyThatWasCutOutFromNoAddress) {
  options.quarantined = {{.principal = "node"}};
  scheduler = Scheduler(options);
  enter(1, "10.0.0.1", 1, 1, "node");
  enter(2, "10.0.0.2", 1, 1, "node");
  enter(3, "10.0.0.1", 1, 1, "other");
  EXPECT_NE(all<SendReject>().at(0).sentence.find("in quarantine. `"), std::string::npos);
  EXPECT_EQ(scheduler.workers().connected(), 1U);
  EXPECT_FALSE(scheduler.forgive("node@10.0.0.2", "a person", now).empty());
  enter(4, "10.0.0.1", 1, 1, "node");
  enter(5, "10.0.0.2", 1, 1, "node");
  EXPECT_EQ(scheduler.workers().trusted(), 3U);
}

TEST_F(Authority, TellsAWorkerThatItIsInQuarantineAndWhenThatIsOver) {
  enter(1, "10.0.0.1", 1, 1, "node");
  credit(1, 1);
  want(1, 3);
  answer(1, 1, 99);
  rule_score(1);
  EXPECT_EQ(only<SendNotice>().peer, 1U);
  EXPECT_NE(only<SendNotice>().sentence.find("it gave 99"), std::string::npos);
  credit(1, 1);
  const std::size_t before = given[1].size();
  EXPECT_TRUE(scheduler.forgive("10.0.0.9", "a person", now).empty());
  EXPECT_EQ(scheduler.forgive("node", "a person", now), std::vector<std::string>{"node@10.0.0.1"});
  take();
  EXPECT_EQ(all<Forgiven>().size(), 1U);
  EXPECT_EQ(all<SendNotice>().size(), 2U);
  EXPECT_EQ(all<WorkerChanged>().back().row.state, WorkerState::Connected);
  EXPECT_EQ(std::ranges::count(kinds(), "workers forgiven"), 1);
  // It works again as an unknown one: the referee makes its first results again.
  credit(1, 1);
  ASSERT_GT(given[1].size(), before);
  const std::size_t accepted = all<OutcomeAccepted>().size();
  const std::int64_t candidate = given[1][before];
  answer(1, candidate);
  EXPECT_EQ(all<OutcomeAccepted>().size(), accepted);
  EXPECT_EQ(asked(), key(candidate));
  rule_score(candidate);
  EXPECT_EQ(all<OutcomeAccepted>().size(), accepted + 1);
  EXPECT_TRUE(scheduler.forgive("node", "a person", now).empty());
}

// --- without keys a process is blamed ---

TEST_F(Authority, BlamesAProcessWhereThereAreNoKeys) {
  enter(1, "127.0.0.1");
  prove(1, 1);
  enter(2, "127.0.0.1");
  give(2, 10);
  ASSERT_EQ(given[2], std::vector<std::int64_t>{10});
  answer(2, 10, 99);
  EXPECT_EQ(all<OutcomeAccepted>().size(), 2U) << "that the other one is known says nothing of it";
  rule_score(10);
  EXPECT_EQ(scheduler.counters().quarantined, 1U);
  EXPECT_EQ(scheduler.workers().trusted(), 1U);
  EXPECT_TRUE(all<StopCampaign>().empty()) << "nothing of it counts, and the other one is here";
  // The same process may not come again, another may.
  enter(2, "127.0.0.1", 1, 2);
  EXPECT_EQ(scheduler.workers().trusted(), 1U);
  enter(3, "127.0.0.1");
  EXPECT_EQ(scheduler.workers().trusted(), 2U);
  sequence = 100;  // of the first one's connection
  give(1, 20);
  EXPECT_EQ(given[1].back(), 20);
}

TEST_F(Authority, BelievesNothingOfAnEarlierProcessThatMayHaveBeenTheLiar) {
  enter(1, "127.0.0.1");
  prove(1, 1);
  give(1, 5);
  answer(1, 5);
  if (asked()) rule_score(5);
  // A result of it that was not made again; then it leaves, and one comes that lies.
  for (std::int64_t i = 6; i < 60; ++i) {
    give(1, i);
    answer(1, i);
    if (asked()) rule_score(i);
  }
  scheduler.on_goodbye({1, 1, ++sequence}, now);
  move();
  enter(2, "127.0.0.1");
  give(2, 100);
  answer(2, 100, 99);
  rule_score(100);
  EXPECT_TRUE(only<StopCampaign>().distrusted);
}

TEST_F(Authority, QuarantinesAHostWithoutKeysAfterThreeLiars) {
  for (PeerId peer = 1; peer <= 3; ++peer) {
    enter(peer, "127.0.0.1");
    ASSERT_EQ(scheduler.workers().trusted(), 1U);
    const auto candidate = static_cast<std::int64_t>(peer);
    give(peer, candidate);
    answer(peer, candidate, 99);
    rule_score(candidate);
  }
  enter(4, "127.0.0.1");
  EXPECT_EQ(scheduler.workers().trusted(), 0U);
  EXPECT_TRUE(scheduler.principals().all().at("loopback").quarantined);
  EXPECT_FALSE(scheduler.forgive("loopback", "a person", now).empty());
  enter(5, "127.0.0.1");
  EXPECT_EQ(scheduler.workers().trusted(), 4U) << "the liars of before, too";
}

TEST_F(Authority, RemembersAProcessWithoutAKey) {
  options.quarantined = {
      {.principal = "loopback", .identity = hexadecimal(std::string(15, 's') + 'b')}};
  scheduler = Scheduler(options);
  enter(1, "127.0.0.1");
  enter(2, "127.0.0.1");
  EXPECT_EQ(all<SendReject>().size(), 1U);
  EXPECT_EQ(scheduler.workers().trusted(), 1U);
}

TEST_F(Authority, LetsTheRefereeJudgeWhoContradictsAStoredScore) {
  enter(1, "10.0.0.1");
  prove(1, 1);
  enter(2, "10.0.0.2");
  prove(2, 3);
  give(1, 10);
  const std::uint64_t signature = give_back(1, 10);
  credit(2, 1);
  answer(2, 10, 1, "", 2);
  if (asked()) rule_score(10);
  ASSERT_TRUE(scheduler.principals().all().at("10.0.0.1").taken > 0);
  // The first one comes with a lie.
  answer(1, {.key = key(10), .attempt = 1, .measured = {.score = 99}, .signature = signature});
  dispute(10);
  ASSERT_EQ(all<ConflictFound>().size(), 1U);
  ASSERT_EQ(asked(), key(10));
  rule_score(10);
  EXPECT_EQ(scheduler.principals().all().at("10.0.0.1").liars.size(), 1U);
  EXPECT_TRUE(scheduler.principals().all().at("10.0.0.2").liars.empty());
  EXPECT_TRUE(all<StopCampaign>().empty()) << "all that it said before was made again";
  EXPECT_TRUE(std::ranges::any_of(all<AttemptEnded>(), [](const AttemptEnded& ended) {
    return pack(ended.row.key) == key(10) && ended.row.outcome == AttemptOutcome::Audited;
  })) << "what was kept was made again: the store is sound";
}

TEST_F(Authority, StopsWhenAStoredScoreIsWrong) {
  hello(1), hello(2);
  give(1, 1);
  const std::uint64_t signature = give_back(1, 1);
  credit(2, 1);
  answer(2, 1, 99, "", 2);
  answer(1, {.key = key(1),
             .attempt = 1,
             .measured = {.score = 1, .state_digest = 5},
             .signature = signature});
  dispute(1);
  rule_score(1);
  EXPECT_TRUE(only<StopCampaign>().distrusted);
}

}  // namespace
}  // namespace swarmsmith
