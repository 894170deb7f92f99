#include "worker/protocol.h"

#include <algorithm>
#include <deque>
#include <initializer_list>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "proto/task_messages.h"
#include "proto/wire.pb.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

const std::string kId(kWorkerIdBytes, 'w');
const std::string kDigest = std::to_string(digest_of_scenario("scenario"));

/// Incarnation and sequence, then the body.
std::string line_of(pb::ToCoordinator message) {
  const std::string numbers =
      std::to_string(message.incarnation()) + "." + std::to_string(message.sequence()) + " ";
  message.clear_incarnation();
  message.clear_sequence();
  std::string text = numbers + message.ShortDebugString();
  while (text.ends_with(' '))
    text.pop_back();
  return text;
}

std::string line_of(const RunItems& run) {
  std::string line = "run";
  for (const LeasedTask& item : run.items)
    line += " " + std::to_string(candidate_of(item.key));
  return line;
}

/// A worker of one slot, and a coordinator played by hand.
class Protocol : public ::testing::Test {
 protected:
  void SetUp() override {
    protocol->start(now);
    take();
  }

  /// Runs the actions so far; messages are kept.
  void take() {
    said.clear();
    done.clear();
    for (WorkerAction& action : protocol->take_actions()) {
      if (auto* send = std::get_if<SendToCoordinator>(&action)) {
        google::protobuf::Arena arena;
        const auto message = value_of(decode_to_coordinator(send->frame, arena));
        said.push_back(*message);
        done.push_back(line_of(*message));
        incarnation = message->incarnation();
      }
      if (auto* run = std::get_if<RunItems>(&action)) {
        done.push_back(line_of(*run));
        for (LeasedTask& item : run->items)
          given.push_back(item.key);
      }
      if (std::holds_alternative<OpenConnection>(action)) {
        ++connections;
        done.emplace_back("open");
      }
      if (std::holds_alternative<TakeBack>(action)) done.emplace_back("take back");
      if (std::holds_alternative<DropItems>(action)) done.emplace_back("drop items");
      if (auto* say = std::get_if<Say>(&action)) done.push_back("say " + say->sentence);
      if (auto* use = std::get_if<UseScenario>(&action)) done.push_back("use " + use->scenario);
      if (auto* leave = std::get_if<Leave>(&action)) {
        left = *leave;
        done.push_back("leave " + std::to_string(static_cast<int>(leave->code)) + ": " +
                       leave->reason);
      }
    }
  }

  /// Begins anew, with another identity or other options.
  void begin(WorkerIdentity identity, const WorkerOptions& options = {}) {
    identity.id = kId;
    protocol.emplace(identity, options, Rng(1));
    given.clear();
    protocol->start(now);
    take();
  }

  void hear(pb::ToWorker message) {
    if (message.incarnation() == 0) message.set_incarnation(incarnation);
    protocol->on_frame(encode(message), now);
    take();
  }

  void pass(Duration time) {
    now += time;
    protocol->on_tick(now);
    take();
  }

  static pb::ToWorker welcome() {
    pb::ToWorker message;
    message.mutable_welcome()->set_scenario(digest_of_scenario("scenario"));
    message.mutable_welcome()->set_max_credit(4096);
    return message;
  }
  void be_welcome(std::int64_t dead_after_ms = 0) {
    pb::ToWorker message = welcome();
    message.mutable_welcome()->set_dead_after_ms(dead_after_ms);
    hear(message);
    get_scenario();
  }

  void get_scenario() {
    pb::ToWorker scenario;
    scenario.mutable_scenario()->set_scenario("scenario");
    hear(scenario);
  }

  void get_tasks(int first, int count, int attempt = 1) {
    pb::ToWorker message;
    message.mutable_tasks()->set_scenario(digest_of_scenario("scenario"));
    for (int i = first; i < first + count; ++i) {
      pb::Task& task = *message.mutable_tasks()->add_tasks();
      task.mutable_key()->set_candidate(i);
      task.set_attempt(attempt);
    }
    hear(message);
  }

  static PackedKey key(int i) { return pack(i, 0, 0); }

  void finish(int i, const std::string& failure = "") { finish_in(300, i, failure); }
  void finish_in(std::int64_t wall_us, int i, const std::string& failure = "") {
    protocol->on_evaluated(
        {.key = key(i), .measured = {.score = 1.5, .wall_us = wall_us}, .failure = failure}, now);
    take();
  }

  void acknowledge(int i) {
    pb::ToWorker message;
    unpack(key(i), *message.mutable_acknowledged()->add_keys());
    hear(message);
  }

  int results_said() const {
    int count = 0;
    for (const auto& message : said)
      count += message.results().results_size();
    return count;
  }
  bool said_body(pb::ToCoordinator::BodyCase body) const {
    for (const auto& message : said) {
      if (message.body_case() == body) return true;
    }
    return false;
  }

  TimePoint now{seconds(100)};
  std::optional<WorkerProtocol> protocol{std::in_place, WorkerIdentity{.id = kId}, WorkerOptions{},
                                         Rng(1)};
  std::vector<std::string> done;  ///< the last actions, a line each
  std::vector<pb::ToCoordinator> said;
  std::vector<PackedKey> given;
  std::uint64_t incarnation = 0;
  int connections = 0;
  std::optional<Leave> left;
};

TEST_F(Protocol, SaysHelloThenAsksForTheScenarioThenForWork) {
  EXPECT_THAT(done, ElementsAre("open", "1.1 hello { worker_id: \"" + kId + "\" slots: 1 }"));
  get_scenario();  // before the welcome
  EXPECT_THAT(done, IsEmpty());
  hear(welcome());
  EXPECT_THAT(done, ElementsAre("drop items", "1.2 want_scenario { }"));
  get_scenario();
  EXPECT_THAT(done, ElementsAre("use scenario", "1.3 credit { tasks: 2 }"));
  get_scenario();
  EXPECT_THAT(done, IsEmpty()) << "it has it";
  hear(welcome());
  EXPECT_THAT(done, IsEmpty()) << "it is welcome already";
}

TEST_F(Protocol, IntroducesItselfWithNamesOfLimitedLength) {
  const std::string name(kMaxNameBytes, 'n');
  begin({.build = name + "b",
         .engine_version = 3,
         .self_test = "bits",
         .slots = 5,
         .host = name + "h",
         .pid = 77,
         .job = name + "j",
         .cpu = name + "c",
         .secret = "hush"});
  EXPECT_THAT(done, ElementsAre("open", "1.1 hello { worker_id: \"" + kId + "\" build: \"" + name +
                                            "\" engine_version: 3 self_test: \"bits\" slots: 5 "
                                            "host: \"" +
                                            name + "\" pid: 77 job: \"" + name + "\" cpu: \"" +
                                            name + "\" secret: \"hush\" }"));
}

TEST_F(Protocol, AsksForMoreWhenEvaluationsAreShort) {
  be_welcome();
  get_tasks(1, 2);
  finish(1);
  EXPECT_TRUE(said_body(pb::ToCoordinator::kCredit)) << "with the results";
  get_tasks(3, 1);
  protocol->on_started(key(2), now);
  pass(seconds(1));
  ASSERT_TRUE(said_body(pb::ToCoordinator::kHeartbeat));
  // 2 a slot, and 20 ms of 0.3 ms each.
  for (const auto& message : said) {
    if (message.has_heartbeat()) {
      EXPECT_EQ(message.heartbeat().credit(), 68U);
      ASSERT_EQ(message.heartbeat().running_size(), 1) << "the third has not begun";
      EXPECT_EQ(message.heartbeat().running(0).elapsed_ms(), 1000);
    }
  }
}

TEST_F(Protocol, GathersResultsWhileThereIsWork) {
  be_welcome();
  get_tasks(1, 10);
  finish(1);
  EXPECT_EQ(results_said(), 0);
  pass(milliseconds(4));
  EXPECT_EQ(results_said(), 0) << "more may come until 5 ms are over";
  pass(milliseconds(1));
  EXPECT_EQ(results_said(), 1);
  for (int i = 2; i <= 8; ++i)
    finish(i);
  EXPECT_EQ(results_said(), 0);
  finish(9);  // one left: the slot would run dry
  EXPECT_EQ(results_said(), 8);
}

TEST_F(Protocol, SendsAgainWhatIsNotAcknowledged) {
  be_welcome();
  get_tasks(1, 1);
  finish(1);
  EXPECT_EQ(results_said(), 1);
  for (int i = 0; i < 9; ++i) {
    pb::ToWorker beat;
    beat.mutable_heartbeat();
    hear(beat);
    pass(seconds(1));
    EXPECT_EQ(results_said(), 0);
  }
  pass(seconds(1));
  EXPECT_EQ(results_said(), 1);
  acknowledge(1);
  EXPECT_EQ(protocol->unacknowledged(), 0U);
}

TEST_F(Protocol, ComesBackWithWhatItHolds) {
  be_welcome();
  get_tasks(1, 3);
  finish(1);
  protocol->on_connection_lost(now);
  pass(seconds(1));
  EXPECT_EQ(connections, 2);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].incarnation(), 2U);
  EXPECT_EQ(said[0].hello().holds_size(), 2);
  hear(welcome());
  EXPECT_EQ(results_said(), 1);
  EXPECT_TRUE(said_body(pb::ToCoordinator::kCredit));
}

TEST_F(Protocol, ReturnsTheSignatureOfItsLease) {
  be_welcome();
  pb::ToWorker message;
  message.mutable_tasks()->set_scenario(digest_of_scenario("scenario"));
  for (int i = 1; i <= 2; ++i) {
    pb::Task& task = *message.mutable_tasks()->add_tasks();
    task.mutable_key()->set_candidate(i);
    task.set_attempt(7);
    task.set_signature(70 + static_cast<std::uint64_t>(i));
  }
  hear(message);
  finish(1);
  ASSERT_EQ(results_said(), 1);
  for (const auto& one : said) {
    if (!one.has_results()) continue;
    EXPECT_EQ(one.results().results(0).signature(), 71U);
  }
  protocol->on_connection_lost(now);
  pass(seconds(1));
  ASSERT_EQ(said.size(), 1U);
  const pb::Hello& hello = said[0].hello();
  ASSERT_EQ(hello.signatures_size(), 1);
  EXPECT_EQ(hello.holds(0).candidate(), 2);
  EXPECT_EQ(hello.signatures(0), 72U);
  EXPECT_EQ(hello.attempts(0), 7);
}

TEST_F(Protocol, SaysThatItBeginsBeforeWhatRunsAlone) {
  be_welcome();
  pb::ToWorker message;
  message.mutable_tasks()->set_scenario(digest_of_scenario("scenario"));
  pb::Task& task = *message.mutable_tasks()->add_tasks();
  task.mutable_key()->set_candidate(1);
  task.set_alone(true);
  hear(message);
  EXPECT_TRUE(said_body(pb::ToCoordinator::kBegan));
  EXPECT_TRUE(given.empty());
  EXPECT_EQ(protocol->next_deadline(), now + milliseconds(20));
  pass(milliseconds(19));
  EXPECT_TRUE(given.empty());
  pass(milliseconds(1));
  EXPECT_EQ(given, std::vector<PackedKey>{key(1)});
}

TEST_F(Protocol, GivesBackWhatItHasNotBegun) {
  be_welcome();
  pb::ToWorker message;
  message.mutable_tasks()->set_scenario(digest_of_scenario("scenario"));
  pb::Task& task = *message.mutable_tasks()->add_tasks();
  task.mutable_key()->set_candidate(1);
  task.set_alone(true);
  hear(message);
  protocol->on_drain(now);
  take();
  EXPECT_TRUE(said_body(pb::ToCoordinator::kReturned));
  pass(seconds(1));
  EXPECT_TRUE(given.empty());
}

TEST_F(Protocol, DropsEverythingWhenAnotherCampaignRuns) {
  be_welcome();
  get_tasks(1, 3);
  finish(1);
  protocol->on_connection_lost(now);
  pass(seconds(1));
  pb::ToWorker other;
  other.mutable_welcome()->set_scenario(1);
  hear(other);
  EXPECT_THAT(done, ElementsAre("drop items", "2.2 want_scenario { }"));
  EXPECT_EQ(protocol->held(), 0U);
  EXPECT_EQ(protocol->unacknowledged(), 0U);
  EXPECT_TRUE(said_body(pb::ToCoordinator::kWantScenario));
  pass(milliseconds(999));
  EXPECT_FALSE(said_body(pb::ToCoordinator::kWantScenario));
  pass(milliseconds(1));
  EXPECT_TRUE(said_body(pb::ToCoordinator::kWantScenario)) << "once a second";
}

TEST_F(Protocol, NoticesASilentCoordinator) {
  be_welcome();
  for (int i = 0; i < 6; ++i)
    pass(seconds(1));
  EXPECT_FALSE(protocol->active());
  for (int i = 0; i < 3; ++i)
    pass(seconds(1));
  EXPECT_GE(connections, 2);
}

TEST_F(Protocol, WaitsForASilentCoordinatorAsLongAsItWasTold) {
  be_welcome(20'000);
  for (int i = 0; i < 20; ++i)
    pass(seconds(1));
  EXPECT_TRUE(protocol->active());
  pass(seconds(1));
  EXPECT_FALSE(protocol->active());
}

/// Of a connection that it has closed, or of a coordinator that it has left, nothing counts.
TEST_F(Protocol, HearsNothingWhileItWaitsAndAfterItHasLeft) {
  be_welcome();
  const std::uint64_t before = incarnation;
  protocol->on_connection_lost(now);
  take();
  pb::ToWorker tasks;
  tasks.set_incarnation(before);
  tasks.mutable_tasks()->set_scenario(digest_of_scenario("scenario"));
  tasks.mutable_tasks()->add_tasks()->mutable_key()->set_candidate(1);
  hear(tasks);
  EXPECT_TRUE(given.empty());
  EXPECT_TRUE(said.empty());
  pb::ToWorker reject;
  reject.set_incarnation(before);
  reject.mutable_reject()->set_sentence("another build");
  hear(reject);
  EXPECT_FALSE(left) << "from before the connection was lost";

  pass(seconds(5));
  ASSERT_EQ(connections, 2);
  reject.set_incarnation(incarnation);
  hear(reject);
  ASSERT_TRUE(left);
  left.reset();
  tasks.set_incarnation(incarnation);
  hear(tasks);
  hear(reject);
  EXPECT_TRUE(given.empty());
  EXPECT_TRUE(said.empty());
  EXPECT_FALSE(left) << "it leaves once";
}

TEST_F(Protocol, GivesUpAfterTenMinutes) {
  for (int i = 0; i < 700 && !left; ++i)
    pass(seconds(1));
  ASSERT_TRUE(left);
  EXPECT_EQ(left->code, WorkerExit::Unreachable);
}

TEST_F(Protocol, LeavesWithItsOwnCodeWhenItIsRefused) {
  pb::ToWorker reject;
  reject.mutable_reject()->set_sentence("another build");
  hear(reject);
  ASSERT_TRUE(left);
  EXPECT_EQ(left->code, WorkerExit::Refused);
  EXPECT_EQ(left->reason, "another build");
}

/// A launcher may then try again later.
TEST_F(Protocol, LeavesWithAnotherCodeWhenThereIsNoPlaceForIt) {
  pb::ToWorker reject;
  reject.mutable_reject()->set_reason(pb::Reject::REASON_LIMIT);
  reject.mutable_reject()->set_sentence("there are 5 workers already, the limit");
  hear(reject);
  ASSERT_TRUE(left);
  EXPECT_EQ(static_cast<int>(left->code), 8);
  EXPECT_EQ(left->reason, "there are 5 workers already, the limit");
}

TEST_F(Protocol, LeavesWhenTheCoordinatorSpeaksAnotherVersion) {
  std::string frame = encode(pb::ToWorker());
  frame[4] = 9;
  protocol->on_frame(frame, now);
  take();
  ASSERT_TRUE(left);
  EXPECT_EQ(left->code, WorkerExit::Refused);
}

TEST_F(Protocol, DrainsByGivingBackAndWaitingForTheDisk) {
  be_welcome();
  get_tasks(1, 3);
  protocol->on_drain(now);
  take();
  EXPECT_THAT(done, ElementsAre("1.4 credit { }", "take back"));
  const std::vector<PackedKey> waiting{key(2), key(3)};
  protocol->on_taken_back(waiting, now);
  take();
  EXPECT_TRUE(said_body(pb::ToCoordinator::kReturned));
  finish(1);
  EXPECT_EQ(results_said(), 1);
  EXPECT_FALSE(left);
  acknowledge(1);
  pass(milliseconds(1));
  EXPECT_THAT(done, ElementsAre("1.7 goodbye { }", "leave 0: drained"));
  protocol->on_drain(now);
  take();
  EXPECT_THAT(done, IsEmpty()) << "it leaves once";
}

TEST_F(Protocol, GivesBackWhatFailedWhileDraining) {
  be_welcome();
  get_tasks(1, 1);
  protocol->on_drain(now);
  take();
  finish(1, "killed by SIGTERM");
  EXPECT_EQ(results_said(), 0);
  EXPECT_TRUE(said_body(pb::ToCoordinator::kReturned));
  ASSERT_TRUE(left);
  EXPECT_EQ(left->code, WorkerExit::Done);
}

TEST_F(Protocol, DrainsNoLongerThanTheGraceTime) {
  be_welcome();
  get_tasks(1, 1);
  protocol->on_drain(now);
  pass(seconds(1));
  EXPECT_FALSE(left);
  pass(seconds(1));
  pass(seconds(1));
  pass(seconds(2));
  EXPECT_TRUE(left);
}

TEST_F(Protocol, RunsATaskOnceHoweverOftenItComes) {
  be_welcome();
  get_tasks(1, 2);
  get_tasks(1, 2);
  EXPECT_EQ(given.size(), 2U);
  finish(1);
  get_tasks(1, 1);
  EXPECT_EQ(given.size(), 2U);
}

TEST_F(Protocol, TriesAgainWhatFailedBefore) {
  be_welcome();
  get_tasks(1, 1, 1);
  finish(1, "no luck");
  get_tasks(1, 1, 2);
  EXPECT_EQ(given.size(), 2U);
}

TEST_F(Protocol, SaysHelloAgainWhenItIsNotKnown) {
  be_welcome();
  pb::ToWorker who;
  who.mutable_who_are_you();
  hear(who);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].body_case(), pb::ToCoordinator::kHello);
  EXPECT_EQ(said[0].incarnation(), 2U);
  EXPECT_EQ(connections, 1);
}

/// The coordinator may have read the hello, and would find a worker that hangs up without a word.
TEST_F(Protocol, SaysGoodbyeThoughItIsNotWelcomeYet) {
  protocol->on_drain(now);
  take();
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].body_case(), pb::ToCoordinator::kGoodbye);
  EXPECT_EQ(said[0].incarnation(), 1U);
  ASSERT_TRUE(left);
  EXPECT_EQ(left->code, WorkerExit::Done);
}

/// For messages whose fields depend on the lease.
pb::ToWorker tasks_of(std::initializer_list<pb::Task> tasks) {
  pb::ToWorker message;
  message.mutable_tasks()->set_scenario(digest_of_scenario("scenario"));
  for (const pb::Task& task : tasks)
    *message.mutable_tasks()->add_tasks() = task;
  return message;
}

pb::Task task(int candidate, int attempt, std::uint64_t signature, bool alone = false) {
  pb::Task made;
  made.mutable_key()->set_candidate(candidate);
  made.set_attempt(attempt);
  made.set_signature(signature);
  made.set_alone(alone);
  return made;
}

std::string results_line(const std::string& numbers, const std::string& results) {
  return numbers + " results { scenario: " + kDigest + " " + results + " }";
}

TEST_F(Protocol, DoesForEachTaskOfAMessageWhatItNeeds) {
  be_welcome();
  hear(tasks_of({task(1, 1, 11), task(2, 1, 12), task(3, 1, 13), task(4, 2, 14)}));
  EXPECT_THAT(done, ElementsAre("run 1 2 3 4"));
  finish(1);
  finish(2, "no luck");
  finish(3, "no luck");
  protocol->on_connection_lost(now);
  pass(seconds(1));
  hear(welcome());
  // A success, a failure that is not tried again, one that is, a task that it holds, two new ones.
  hear(tasks_of({task(1, 5, 51), task(2, 1, 52), task(3, 2, 53), task(4, 3, 54), task(5, 1, 55),
                 task(6, 1, 56, true), task(7, 1, 57)}));
  EXPECT_THAT(done, ElementsAre("2.4 began { key { candidate: 6 } }", "run 3 5 7"));
  EXPECT_EQ(protocol->held(), 5U);
  pass(milliseconds(20));
  const std::string success =
      "results { key { candidate: 1 } attempt: 5 score: 1.5 wall_us: 300 "
      "signature: 51 }";
  const std::string failure =
      "results { key { candidate: 2 } attempt: 1 score: 1.5 wall_us: 300 "
      "failure: \"no luck\" signature: 12 }";
  EXPECT_THAT(done, ElementsAre("run 6", results_line("2.5", success + " " + failure)));
  for (const int i : {3, 4}) {
    acknowledge(i == 3 ? 1 : 2);
    finish(i);
  }
  pass(milliseconds(5));
  EXPECT_THAT(done, ElementsAre(results_line(
                        "2.6",
                        "results { key { candidate: 3 } attempt: 2 score: 1.5 wall_us: 300 "
                        "signature: 53 } results { key { candidate: 4 } attempt: 3 score: 1.5 "
                        "wall_us: 300 signature: 54 }")));
}

TEST_F(Protocol, TakesNoTasksOfAnotherScenarioNorBeforeItsOwn) {
  pb::ToWorker tasks = tasks_of({task(1, 1, 1)});
  hear(tasks);
  hear(welcome());
  hear(tasks);
  EXPECT_EQ(protocol->held(), 0U);
  pb::ToWorker wrong;
  wrong.mutable_scenario()->set_scenario("another scenario");
  hear(wrong);
  EXPECT_THAT(done, IsEmpty());
  get_scenario();
  tasks.mutable_tasks()->set_scenario(7);
  hear(tasks);
  EXPECT_THAT(done, IsEmpty());
  EXPECT_EQ(protocol->held(), 0U);
}

TEST_F(Protocol, HeedsOnlyAcknowledgementsAndQuestionsOfEarlierIncarnations) {
  be_welcome();
  get_tasks(1, 2);
  finish(1);
  protocol->on_connection_lost(now);
  pass(seconds(1));
  std::vector<pb::ToWorker> stale(6);
  stale[0] = welcome();
  stale[1].mutable_reject()->set_sentence("go away");
  stale[2] = tasks_of({task(3, 1, 1)});
  stale[3].mutable_scenario()->set_scenario("scenario");
  stale[4].mutable_drain();
  stale[5].mutable_notice()->set_sentence("an old notice");
  const auto hear_all = [&](std::uint64_t of) {
    std::vector<std::string> all;
    for (pb::ToWorker message : stale) {
      message.set_incarnation(of);
      hear(message);
      all.insert(all.end(), done.begin(), done.end());
    }
    return all;
  };
  EXPECT_THAT(hear_all(1), IsEmpty());
  EXPECT_FALSE(protocol->active());
  hear(welcome());
  EXPECT_THAT(hear_all(1), IsEmpty());
  EXPECT_THAT(hear_all(3), IsEmpty());
  EXPECT_EQ(protocol->held(), 1U);
  pb::ToWorker acknowledged;
  acknowledged.set_incarnation(1);
  unpack(key(1), *acknowledged.mutable_acknowledged()->add_keys());
  hear(acknowledged);
  EXPECT_EQ(protocol->unacknowledged(), 0U);
  pb::ToWorker notice = stale[5];
  notice.set_incarnation(2);
  hear(notice);
  EXPECT_THAT(done, ElementsAre("say an old notice"));
  pb::ToWorker who;
  who.set_incarnation(1);
  who.mutable_who_are_you();
  hear(who);
  EXPECT_THAT(done, ElementsAre("3.1 hello { worker_id: \"" + kId + "\" slots: 1 scenario: " +
                                kDigest + " holds { candidate: 2 } attempts: 1 signatures: 0 }"));
  hear(who);
  EXPECT_THAT(done, IsEmpty()) << "it has said it";
  // Of a coordinator that could not read the hello.
  pb::ToWorker reject = stale[1];
  protocol->on_frame(encode(reject), now);
  take();
  EXPECT_THAT(done, ElementsAre("leave 7: go away"));
}

/// Messages for earlier incarnations are no sign of life for this one.
TEST_F(Protocol, NoticesSilenceAfterMoreThanTheTimeThatItWasTold) {
  for (const bool current : {true, false}) {
    begin({.slots = 1});
    be_welcome(4000);
    for (int i = 0; i < 4; ++i)
      pass(seconds(1));
    EXPECT_TRUE(protocol->active()) << "4 s are allowed";
    pb::ToWorker beat;
    beat.mutable_heartbeat();
    beat.set_incarnation(current ? 1 : 9);
    hear(beat);
    pass(Duration(1));
    EXPECT_EQ(protocol->active(), current);
  }
}

/// A process that was stopped for more than half of the time could not hear anything.
TEST_F(Protocol, DoesNotTakeItsOwnPauseForSilence) {
  be_welcome(4000);
  pass(seconds(2) + Duration(1));
  pass(seconds(2));
  pass(seconds(2));
  EXPECT_TRUE(protocol->active());
  pass(seconds(1));
  EXPECT_FALSE(protocol->active());
}

/// Half the pause up to one and a half, evenly; pauses double up to the longest one.
TEST_F(Protocol, PausesRandomlyBeforeANewConnection) {
  const auto pause = [&](WorkerProtocol& worker) {
    worker.on_connection_lost(now);
    const Duration left = worker.next_deadline() - now;
    worker.take_actions();
    now += left - Duration(1);
    worker.on_tick(now);
    EXPECT_TRUE(worker.take_actions().empty());
    now += Duration(1);
    worker.on_tick(now);
    EXPECT_EQ(worker.take_actions().size(), 2U) << "a connection and a hello";
    return seconds_of(left);
  };
  const std::vector<double> wanted = {0.1, 0.2, 0.4, 0.8, 1.6, 2.5, 2.5};
  std::vector<double> least(wanted.size(), 100);
  std::vector<double> most(wanted.size(), 0);
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    WorkerProtocol worker({.id = kId}, {.longest_backoff = milliseconds(2500)}, Rng(seed));
    worker.start(now);
    worker.take_actions();
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const double factor = pause(worker) / wanted[i];
      least[i] = std::min(least[i], factor);
      most[i] = std::max(most[i], factor);
    }
    if (seed > 0) continue;
    pb::ToWorker message = welcome();
    message.set_incarnation(wanted.size() + 1);
    worker.on_frame(encode(message), now);
    EXPECT_LE(pause(worker), 0.15) << "after a welcome they begin anew";
  }
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    EXPECT_NEAR(least[i], 0.5, 0.03);
    EXPECT_NEAR(most[i], 1.5, 0.03);
  }
}

TEST_F(Protocol, WaitsForAWelcomeAndForACoordinatorNoLongerThanItsOptionsSay) {
  const WorkerOptions options{.first_backoff = milliseconds(1),
                              .longest_backoff = milliseconds(1),
                              .welcome_timeout = seconds(3),
                              .give_up_after = seconds(60)};
  begin({.slots = 1}, options);
  EXPECT_EQ(protocol->next_deadline(), now + seconds(3));
  pass(seconds(3));
  EXPECT_EQ(protocol->next_deadline(), now) << "not yet lost";
  pass(Duration(1));
  EXPECT_GT(protocol->next_deadline(), now) << "a pause";
  const auto lose_until = [&](Duration time) {
    protocol->on_connection_lost(now);
    pass(time);
    const std::vector<std::string> first = done;
    protocol->on_connection_lost(now);
    pass(Duration(1));
    return std::pair(first.size(), done);
  };
  const std::vector<std::string> gives_up = {"leave 5: no coordinator for too long"};
  EXPECT_EQ(lose_until(seconds(57) - Duration(1)), std::pair(std::size_t{2}, gives_up));
  EXPECT_EQ(protocol->next_deadline(), now);
  // Counted from the loss of a coordinator, or from its question who this is.
  for (const bool asked : {false, true}) {
    begin({.slots = 1}, options);
    be_welcome(3'600'000);
    pass(seconds(59));
    if (asked) {
      pb::ToWorker who;
      who.mutable_who_are_you();
      hear(who);
    }
    EXPECT_EQ(lose_until(seconds(60)), std::pair(std::size_t{2}, gives_up));
  }
}

TEST_F(Protocol, SaysAllNumbersInItsHeartbeat) {
  begin({.slots = 3});
  pb::ToWorker message = welcome();
  message.mutable_welcome()->set_heartbeat_ms(700);
  message.mutable_welcome()->set_max_credit(5);
  hear(message);
  EXPECT_EQ(protocol->next_deadline(), now + milliseconds(700));
  pass(milliseconds(699));
  EXPECT_THAT(done, IsEmpty());
  pass(milliseconds(1));
  EXPECT_THAT(done, ElementsAre("1.3 heartbeat { slot_us: 2100000 }")) << "no scenario, no credit";
  get_scenario();
  EXPECT_THAT(done, ElementsAre("use scenario", "1.4 credit { tasks: 5 }"));
  get_tasks(1, 6);
  protocol->on_started(key(1), now);
  protocol->on_started(key(2), now);
  protocol->on_started(key(99), now);  // it does not hold that
  pass(milliseconds(100));
  finish_in(90'000, 1);
  protocol->on_started(key(3), now);
  pass(milliseconds(300));
  finish_in(0, 3);  // by its start
  pass(milliseconds(300));
  // Busy: 90 ms, 300 ms, and 700 ms of the one that runs.
  ASSERT_EQ(done.size(), 2U) << "after the result";
  EXPECT_EQ(done.back(),
            "1.7 heartbeat { credit: 5 running { key { candidate: 2 } elapsed_ms: 700 "
            "} held: 4 slot_us: 4200000 busy_us: 1090000 }");
  // On a new connection only time since its welcome counts, and no more than there was.
  protocol->on_connection_lost(now);
  pass(seconds(1));
  hear(message);
  pass(milliseconds(10));
  finish_in(500'000, 4);
  finish_in(500'000, 5);
  finish_in(500'000, 6);
  pass(milliseconds(690));
  EXPECT_THAT(done, ElementsAre("2.7 heartbeat { credit: 5 running { key { candidate: 2 } "
                                "elapsed_ms: 2400 } held: 1 slot_us: 2100000 busy_us: 730000 }"));
  begin({.slots = 1});
  be_welcome();
  get_tasks(1, 2);
  protocol->on_started(key(1), now);
  pass(milliseconds(900));
  finish_in(900'000, 1);
  protocol->on_started(key(2), now - milliseconds(200));
  pass(milliseconds(100));
  EXPECT_THAT(done, Contains("1.5 heartbeat { credit: 2 running { key { candidate: 2 } elapsed_ms: "
                             "300 } held: 1 slot_us: 1000000 busy_us: 1000000 }"));
}

/// Above 5/4 of what was said, or below 4/5. Other changes wait for the heartbeat.
TEST_F(Protocol, SaysItsCreditAgainWhenItHasChangedMuch) {
  struct Case {
    std::vector<std::int64_t> wall_us;
    std::vector<int> said;  ///< 8 at first: four slots, two each
  };
  // Two a slot and 20 ms of work; the average gives each later evaluation a weight of 1/20.
  const std::vector<Case> cases = {
      {{40'000}, {}},                 // 10
      {{26'666}, {11}},               // 2.75 a slot
      {{10'000}, {16}},               //
      {{10'000, 100'000}, {16}},      // 14.5 ms: 13
      {{10'000, 170'000}, {16, 12}},  // 18 ms
      {{1000}, {88}},                 //
      {{1}, {4096}},                  // no more than the welcome says
      {{0}, {}},                      //
  };
  for (const Case& each : cases) {
    begin({.slots = 4});
    be_welcome();
    EXPECT_THAT(done, ElementsAre("use scenario", "1.3 credit { tasks: 8 }"));
    get_tasks(1, static_cast<int>(each.wall_us.size()));
    std::vector<int> credits;
    int number = 0;
    for (const std::int64_t wall_us : each.wall_us) {
      finish_in(wall_us, ++number);
      for (const auto& message : said) {
        if (message.has_credit()) credits.push_back(static_cast<int>(message.credit().tasks()));
      }
    }
    EXPECT_EQ(credits, each.said) << each.wall_us.front();
  }
}

TEST_F(Protocol, AsksForNothingWhileTooManyResultsAreNotOnDisk) {
  begin({.slots = 2}, {.max_unacknowledged = 2});
  be_welcome();
  get_tasks(1, 3);
  for (const int i : {1, 2}) {
    finish_in(0, i);
    EXPECT_FALSE(said_body(pb::ToCoordinator::kCredit)) << "two may wait";
  }
  finish_in(0, 3);
  EXPECT_EQ(done.back(), "1.7 credit { }");
  acknowledge(1);
  pass(milliseconds(1));
  EXPECT_THAT(done, ElementsAre("1.8 credit { tasks: 4 }"));
}

TEST_F(Protocol, PutsNoMoreResultsIntoAMessageThanItsOptionsSay) {
  be_welcome();
  get_tasks(1, 140);
  for (int i = 1; i <= 63; ++i) {
    finish(i);
    ASSERT_EQ(results_said(), 0);
  }
  EXPECT_EQ(protocol->next_deadline(), now + milliseconds(5));
  finish(64);
  EXPECT_EQ(results_said(), 64);
  for (int i = 65; i <= 130; ++i)
    finish(i);
  protocol->on_connection_lost(now);
  pass(seconds(1));
  hear(welcome());
  std::vector<int> sizes;
  for (const auto& message : said) {
    if (message.has_results()) sizes.push_back(message.results().results_size());
  }
  EXPECT_THAT(sizes, ElementsAre(64, 64, 2));
}

TEST_F(Protocol, CountsTheTimeUntilItSendsAgainFromTheLastSending) {
  pb::ToWorker message = welcome();
  message.mutable_welcome()->set_resend_ms(3000);
  message.mutable_welcome()->set_dead_after_ms(60'000);
  hear(message);
  get_scenario();
  get_tasks(1, 3);
  finish(1);
  finish(2);
  finish(3);
  pass(milliseconds(5));
  protocol->on_connection_lost(now);
  pass(seconds(1));
  hear(message);
  EXPECT_EQ(results_said(), 3);
  acknowledge(2);
  pass(milliseconds(2500));
  EXPECT_EQ(results_said(), 0);
  pass(milliseconds(499));
  EXPECT_EQ(results_said(), 0);
  pass(milliseconds(1));
  EXPECT_EQ(results_said(), 2) << "the others, though one was acknowledged";
  pass(milliseconds(2999));
  EXPECT_EQ(results_said(), 0);
  pass(milliseconds(1));
  EXPECT_EQ(results_said(), 2);
}

/// Of what it holds, runs and gives back it names as many as a message may have.
TEST_F(Protocol, NamesNoMoreTasksThanAMessageMayHave) {
  be_welcome();
  get_tasks(1, kMaxItemsPerMessage);
  get_tasks(kMaxItemsPerMessage + 1, 1);
  for (int i = 1; i <= kMaxItemsPerMessage + 1; ++i)
    protocol->on_started(key(i), now);
  pass(seconds(1));
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].heartbeat().running_size(), kMaxItemsPerMessage);
  EXPECT_EQ(said[0].heartbeat().held(), kMaxItemsPerMessage + 1U);
  protocol->on_connection_lost(now);
  pass(seconds(1));
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].hello().holds_size(), kMaxItemsPerMessage);
  EXPECT_EQ(said[0].hello().attempts_size(), kMaxItemsPerMessage);
  hear(welcome());
  std::vector<PackedKey> keys(kMaxItemsPerMessage + 1);
  for (std::size_t i = 0; i < keys.size(); ++i)
    keys[i] = key(static_cast<int>(i) + 1);
  protocol->on_taken_back(keys, now);
  take();
  ASSERT_EQ(said.size(), 2U);
  EXPECT_EQ(said[0].returned().keys_size(), kMaxItemsPerMessage);
  EXPECT_EQ(line_of(said[1]),
            "2.4 returned { keys { candidate: " + std::to_string(keys.size()) + " } }");
  EXPECT_EQ(protocol->held(), 0U);
}

TEST_F(Protocol, ForgetsTheResultsOfTasksThatItDoesNotHold) {
  be_welcome();
  finish(1);
  EXPECT_THAT(done, IsEmpty());
  EXPECT_EQ(protocol->unacknowledged(), 0U);
  // Tasks of the campaign before, among them one that would begin later.
  hear(tasks_of({task(1, 1, 1), task(2, 1, 1), task(3, 1, 1), task(4, 1, 1, true)}));
  finish(1);
  protocol->on_connection_lost(now);
  pb::ToWorker other;
  other.mutable_welcome()->set_scenario(digest_of_scenario("other"));
  other.mutable_welcome()->set_max_credit(1);
  pass(milliseconds(10));
  while (!said_body(pb::ToCoordinator::kHello))
    pass(milliseconds(1));
  hear(other);
  other.mutable_scenario()->set_scenario("other");
  hear(other);
  EXPECT_THAT(done, ElementsAre("use other", "2.3 credit { tasks: 1 }"));
  finish(2);
  pass(milliseconds(500));
  EXPECT_THAT(done, IsEmpty());
}

TEST_F(Protocol, BeginsWhatRunsAloneAlsoWithoutAConnection) {
  be_welcome();
  hear(tasks_of({task(1, 1, 1, true)}));
  pass(milliseconds(5));
  hear(tasks_of({task(2, 1, 1, true)}));
  EXPECT_EQ(protocol->next_deadline(), now + milliseconds(15));
  protocol->on_connection_lost(now);
  EXPECT_EQ(protocol->next_deadline(), now + milliseconds(15));
  pass(milliseconds(15));
  EXPECT_EQ(done.front(), "run 1");
  pass(milliseconds(4));
  EXPECT_THAT(given, ElementsAre(key(1)));
  pass(milliseconds(1));
  EXPECT_THAT(given, ElementsAre(key(1), key(2)));
}

TEST_F(Protocol, LeavesWithTheReasonWhyItCannotRunTheCampaign) {
  be_welcome();
  protocol->on_bad_scenario("no such flavour");
  protocol->on_bad_scenario("it leaves once");
  hear(tasks_of({task(1, 1, 1)}));
  take();
  EXPECT_TRUE(protocol->left());
  EXPECT_EQ(left->code, WorkerExit::Refused);
  EXPECT_EQ(left->reason, "this program cannot run the campaign: no such flavour");
}

TEST_F(Protocol, DrainsAsItsConnectionAllows) {
  protocol->on_connection_lost(now);
  protocol->on_drain(now);
  take();
  EXPECT_THAT(done, ElementsAre("leave 0: drained without a connection"));

  begin({.slots = 1});
  protocol->on_drain(now);
  take();
  EXPECT_THAT(done, ElementsAre("1.2 goodbye { }", "leave 0: drained without a welcome"));
  pass(seconds(1));
  EXPECT_THAT(done, IsEmpty());
  EXPECT_EQ(protocol->next_deadline(), now);

  begin({.slots = 1});
  be_welcome();
  get_tasks(1, 1);
  protocol->on_drain(now);
  protocol->on_connection_lost(now);
  take();
  EXPECT_EQ(done.back(), "leave 0: drained without a connection");
}

TEST_F(Protocol, GivesBackTheRestWhenTheGraceTimeIsOver) {
  begin({.slots = 1}, {.grace = milliseconds(800)});
  be_welcome();
  hear(tasks_of({task(1, 1, 1), task(2, 1, 1, true)}));
  protocol->on_drain(now);
  take();
  EXPECT_THAT(done,
              ElementsAre("1.5 credit { }", "take back", "1.6 returned { keys { candidate: 2 } }"));
  EXPECT_EQ(protocol->next_deadline(), now + milliseconds(800));
  pass(milliseconds(400));
  protocol->on_drain(now);
  take();
  EXPECT_THAT(done, IsEmpty()) << "once, and the time does not begin anew";
  hear(tasks_of({task(1, 1, 1), task(3, 1, 1), task(4, 1, 1)}));
  EXPECT_THAT(done, ElementsAre("1.7 returned { keys { candidate: 1 } keys { candidate: 3 } keys { "
                                "candidate: 4 } }",
                                "1.8 goodbye { }", "leave 0: drained"));

  begin({.slots = 1}, {.grace = milliseconds(800)});
  be_welcome();
  get_tasks(1, 2);
  protocol->on_drain(now);
  pass(milliseconds(400));
  finish(1);
  EXPECT_THAT(done, ElementsAre(results_line("1.5",
                                             "results { key { candidate: 1 } attempt: 1 "
                                             "score: 1.5 wall_us: 300 }")));
  pass(milliseconds(399));
  EXPECT_THAT(done, IsEmpty());
  pass(milliseconds(1));
  EXPECT_THAT(done, ElementsAre("1.6 returned { keys { candidate: 2 } }", "1.7 goodbye { }",
                                "leave 0: drained"));
}

TEST(ManyWorkers, DoNotComeBackInStep) {
  // A thousand of them lose a coordinator that is away for a minute.
  constexpr int kWorkers = 1000;
  std::deque<WorkerProtocol> workers;
  TimePoint now{seconds(100)};
  for (std::uint64_t i = 0; i < kWorkers; ++i) {
    workers.emplace_back(WorkerIdentity{.id = std::string(kWorkerIdBytes, 'w')}, WorkerOptions{},
                         Rng(i));
    workers.back().start(now);
    workers.back().take_actions();
  }
  std::vector<int> hellos;  // in each tenth of a second
  for (int tick = 0; tick < 6000; ++tick, now += milliseconds(10)) {
    if (tick % 10 == 0) hellos.push_back(0);
    for (WorkerProtocol& worker : workers) {
      worker.on_tick(now);
      for (const WorkerAction& action : worker.take_actions()) {
        if (!std::holds_alternative<OpenConnection>(action)) continue;
        ++hellos.back();
        worker.on_connection_lost(now);  // no peer listens
      }
      // The first one was lost with the coordinator.
      if (tick == 0) worker.on_connection_lost(now);
    }
  }
  const int all = std::accumulate(hellos.begin(), hellos.end(), 0);
  EXPECT_GT(all, 8 * kWorkers);
  EXPECT_LT(all, 14 * kWorkers);
  // From the time when pauses are 10 s: evenly spread, a thousand in ten seconds.
  EXPECT_LT(*std::max_element(hellos.begin() + 300, hellos.end()), 60);
}

TEST_F(Protocol, IgnoresRubbish) {
  be_welcome();
  protocol->on_frame("rubbish", now);
  protocol->on_frame("", now);
  take();
  EXPECT_TRUE(protocol->active());
}

}  // namespace
}  // namespace swarmsmith
