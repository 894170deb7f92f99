#include "worker/protocol.h"

#include <algorithm>
#include <deque>
#include <numeric>

#include "proto/task_messages.h"
#include "proto/wire.pb.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// A worker of one slot, and a coordinator played by hand.
class Protocol : public ::testing::Test {
 protected:
  void SetUp() override {
    protocol.start(now);
    take();
  }

  /// Runs the actions so far; messages are kept.
  void take() {
    said.clear();
    for (WorkerAction& action : protocol.take_actions()) {
      if (auto* send = std::get_if<SendToCoordinator>(&action)) {
        google::protobuf::Arena arena;
        const auto message = value_of(decode_to_coordinator(send->frame, arena));
        said.push_back(*message);
        incarnation = message->incarnation();
      }
      if (auto* run = std::get_if<RunItems>(&action)) {
        for (LeasedTask& item : run->items)
          given.push_back(item.key);
      }
      if (std::holds_alternative<OpenConnection>(action)) ++connections;
      if (std::holds_alternative<TakeBack>(action)) asked_back = true;
      if (std::holds_alternative<UseScenario>(action)) ++scenarios;
      if (auto* leave = std::get_if<Leave>(&action)) left = *leave;
    }
  }

  void hear(pb::ToWorker message) {
    if (message.incarnation() == 0) message.set_incarnation(incarnation);
    protocol.on_frame(encode(message), now);
    take();
  }

  void pass(Duration time) {
    now += time;
    protocol.on_tick(now);
    take();
  }

  void be_welcome(std::int64_t dead_after_ms = 0) {
    pb::ToWorker welcome;
    welcome.mutable_welcome()->set_dead_after_ms(dead_after_ms);
    welcome.mutable_welcome()->set_scenario(digest_of_scenario("scenario"));
    welcome.mutable_welcome()->set_max_credit(4096);
    hear(welcome);
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

  void finish(int i, const std::string& failure = "") {
    protocol.on_evaluated(
        {.key = key(i), .measured = {.score = 1.5, .wall_us = 300}, .failure = failure}, now);
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
  WorkerProtocol protocol{{.id = std::string(kWorkerIdBytes, 'w')}, {}, Rng(1)};
  std::vector<pb::ToCoordinator> said;
  std::vector<PackedKey> given;
  std::uint64_t incarnation = 0;
  int connections = 0;
  int scenarios = 0;
  bool asked_back = false;
  std::optional<Leave> left;
};

TEST_F(Protocol, SaysHelloThenAsksForTheScenarioThenForWork) {
  EXPECT_EQ(connections, 1);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].body_case(), pb::ToCoordinator::kHello);
  get_scenario();  // before the welcome
  EXPECT_EQ(scenarios, 0);
  be_welcome();
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].credit().tasks(), 2U);
  get_scenario();
  EXPECT_EQ(scenarios, 1) << "it has it";
}

TEST_F(Protocol, AsksForMoreWhenEvaluationsAreShort) {
  be_welcome();
  get_tasks(1, 2);
  finish(1);
  EXPECT_TRUE(said_body(pb::ToCoordinator::kCredit)) << "with the results";
  get_tasks(3, 1);
  protocol.on_started(key(2), now);
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
  EXPECT_EQ(protocol.unacknowledged(), 0U);
}

TEST_F(Protocol, ComesBackWithWhatItHolds) {
  be_welcome();
  get_tasks(1, 3);
  finish(1);
  protocol.on_connection_lost(now);
  pass(seconds(1));
  EXPECT_EQ(connections, 2);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].incarnation(), 2U);
  EXPECT_EQ(said[0].hello().holds_size(), 2);
  pb::ToWorker welcome;
  welcome.mutable_welcome()->set_scenario(digest_of_scenario("scenario"));
  welcome.mutable_welcome()->set_max_credit(4096);
  hear(welcome);
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
  protocol.on_connection_lost(now);
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
  EXPECT_EQ(protocol.next_deadline(), now + milliseconds(20));
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
  protocol.on_drain(now);
  take();
  EXPECT_TRUE(said_body(pb::ToCoordinator::kReturned));
  pass(seconds(1));
  EXPECT_TRUE(given.empty());
}

TEST_F(Protocol, DropsEverythingWhenAnotherCampaignRuns) {
  be_welcome();
  get_tasks(1, 3);
  finish(1);
  protocol.on_connection_lost(now);
  pass(seconds(1));
  pb::ToWorker welcome;
  welcome.mutable_welcome()->set_scenario(1);
  hear(welcome);
  EXPECT_EQ(protocol.held(), 0U);
  EXPECT_EQ(protocol.unacknowledged(), 0U);
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
  EXPECT_FALSE(protocol.active());
  for (int i = 0; i < 3; ++i)
    pass(seconds(1));
  EXPECT_GE(connections, 2);
}

TEST_F(Protocol, WaitsForASilentCoordinatorAsLongAsItWasTold) {
  be_welcome(20'000);
  for (int i = 0; i < 20; ++i)
    pass(seconds(1));
  EXPECT_TRUE(protocol.active());
  pass(seconds(1));
  EXPECT_FALSE(protocol.active());
}

/// Of a connection that it has closed, or of a coordinator that it has left, nothing counts.
TEST_F(Protocol, HearsNothingWhileItWaitsAndAfterItHasLeft) {
  be_welcome();
  const std::uint64_t before = incarnation;
  protocol.on_connection_lost(now);
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
  protocol.on_frame(frame, now);
  take();
  ASSERT_TRUE(left);
  EXPECT_EQ(left->code, WorkerExit::Refused);
}

TEST_F(Protocol, DrainsByGivingBackAndWaitingForTheDisk) {
  be_welcome();
  get_tasks(1, 3);
  protocol.on_drain(now);
  take();
  EXPECT_TRUE(asked_back);
  const std::vector<PackedKey> waiting{key(2), key(3)};
  protocol.on_taken_back(waiting, now);
  take();
  EXPECT_TRUE(said_body(pb::ToCoordinator::kReturned));
  finish(1);
  EXPECT_EQ(results_said(), 1);
  EXPECT_FALSE(left);
  acknowledge(1);
  pass(milliseconds(1));
  EXPECT_TRUE(said_body(pb::ToCoordinator::kGoodbye));
  ASSERT_TRUE(left);
  EXPECT_EQ(left->code, WorkerExit::Done);
}

TEST_F(Protocol, GivesBackWhatFailedWhileDraining) {
  be_welcome();
  get_tasks(1, 1);
  protocol.on_drain(now);
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
  protocol.on_drain(now);
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
  protocol.on_drain(now);
  take();
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].body_case(), pb::ToCoordinator::kGoodbye);
  EXPECT_EQ(said[0].incarnation(), 1U);
  ASSERT_TRUE(left);
  EXPECT_EQ(left->code, WorkerExit::Done);
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
  protocol.on_frame("rubbish", now);
  protocol.on_frame("", now);
  take();
  EXPECT_TRUE(protocol.active());
}

}  // namespace
}  // namespace swarmsmith
