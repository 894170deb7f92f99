#include "coordinator/pool/budgets.h"

#include "coordinator/service/coordinator.h"
#include "proto/wire.h"
#include "proto/wire.pb.h"
#include "storage/rows.h"
#include "tests/coordinator/synthetic_campaign.h"
#include "tests/support/checks.h"
#include "tests/support/flat_campaign.h"

namespace swarmsmith {
namespace {

using cluster::SyntheticCampaign;

TimePoint at(double seconds) {
  return TimePoint(std::chrono::hours(1)) +
         std::chrono::duration_cast<Duration>(std::chrono::duration<double>(seconds));
}

TEST(Budget, OneStrangerLeavesRoomForOthersAndAllHaveTheirs) {
  Budgets budgets;
  std::size_t of_one = 0;
  while (budgets.may_write({"10.0.0.1"}, 200, at(0)))
    ++of_one;
  EXPECT_GT(of_one, 100U);
  EXPECT_TRUE(budgets.may_write({"10.0.0.2"}, 200, at(0)));
  std::size_t of_all = of_one + 1;
  for (int host = 3; host < 1000; ++host)
    of_all += budgets.may_write({"10.0.1." + std::to_string(host)}, 200, at(0)) ? 1U : 0U;
  for (int i = 0; i < 10'000; ++i)
    of_all += budgets.may_write({"10.0.2." + std::to_string(i)}, 200, at(0)) ? 1U : 0U;
  EXPECT_LT(of_all, 2 * of_one + 2);
  EXPECT_TRUE(budgets.may_write({"10.0.0.1", false}, 200, at(0))) << "who is known has its own";
  EXPECT_TRUE(budgets.may_write({"10.0.0.1"}, 200, at(60))) << "later";
}

TEST(Budget, WhatIsLeftOutIsToldOnceAMinute) {
  Budgets budgets;
  for (int i = 0; i < 1000; ++i)
    budgets.leave_out("hello");
  EXPECT_EQ(budgets.take_news(at(0)).size(), 1U);
  budgets.leave_out("hello");
  EXPECT_EQ(budgets.take_news(at(1)).size(), 0U);
  const auto news = budgets.take_news(at(61));
  ASSERT_EQ(news.size(), 1U);
  EXPECT_EQ(news[0].kind, "over budget");
  EXPECT_THAT(news[0].text, HasSubstr("\"times\":1"));
  EXPECT_TRUE(budgets.take_news(at(200)).empty());
  EXPECT_EQ(budgets.left_out().at("hello"), 1001U);
}

/// Each refusal counts itself, and a permission counts nothing.
TEST(Budget, CountsEachRefusalUnderItsName) {
  Budgets budgets;
  ASSERT_TRUE(budgets.may_be_sent(1, 30U << 20U, at(0)));
  EXPECT_TRUE(budgets.left_out().empty());
  EXPECT_FALSE(budgets.may_be_sent(2, 30U << 20U, at(0)));
  EXPECT_EQ(budgets.left_out().at("answer"), 1U);
  std::uint64_t refused = 0;
  for (int i = 0; i < 1000; ++i)
    refused += budgets.may_say_hello(1, {"10.0.0.1"}, at(0)) ? 0U : 1U;
  EXPECT_GT(refused, 100U);
  EXPECT_EQ(budgets.left_out().at("hello"), refused);
}

TEST(Budget, ALargeScenarioIsSentAllTheSame) {
  Budgets budgets;
  EXPECT_TRUE(budgets.may_be_sent(1, 30U << 20U, at(0)));
  EXPECT_FALSE(budgets.may_be_sent(2, 30U << 20U, at(0)));
  EXPECT_TRUE(budgets.may_be_sent(2, 30U << 20U, at(1)));
}

TEST(Budget, EachTextOfAWorkersRowCountsAtLeastItsLength) {
  const std::size_t without = bytes_of(WorkerRow{});
  for (std::string WorkerRow::*text :
       {&WorkerRow::identity, &WorkerRow::host, &WorkerRow::build, &WorkerRow::job, &WorkerRow::cpu,
        &WorkerRow::client, &WorkerRow::principal}) {
    WorkerRow row;
    row.*text = std::string(40, 'x');
    EXPECT_GE(bytes_of(row), without + 40);
    EXPECT_LE(bytes_of(row), without + 2 * 40);
  }
}

constexpr std::int64_t kPrograms = 500;
#ifdef SWARMSMITH_SANITIZED
constexpr PeerId kNodes = 200;  // each frame's arena is mapped anew there
#else
constexpr PeerId kNodes = 2000;
#endif

std::vector<Task> programs_of(std::int64_t count) {
  std::vector<Task> tasks;
  for (std::int64_t i = 1; i <= count; ++i)
    tasks.push_back({{.instance = 1, .seed = i, .machine = "-n 1"}, {{i}, Purpose::Race, 1}});
  return tasks;
}

/// A coordinator and guests played by hand.
class Guests : public ::testing::Test {
 protected:
  explicit Guests(bool programs = false)
      : options{.scheduler = {.evaluates_programs = programs},
                .scenario = std::string(1 << 20, 's')},
        coordinator(options, {{.digest = "d",
                               .source = programs ? static_cast<WorkSource*>(&flat) : &campaign}}) {
  }

  void say(const pb::ToCoordinator& message, PeerId peer) {
    coordinator.on_frame({.id = peer, .address = address}, encode(message), now);
  }
  void hello(PeerId peer, const std::string& host = "guest", int engine = 0) {
    pb::ToCoordinator message;
    message.set_incarnation(1);
    std::string id(kWorkerIdBytes, 'a');
    for (unsigned byte = 0; byte < 4; ++byte)
      id[byte] = static_cast<char>(peer >> (8 * byte));
    message.mutable_hello()->set_worker_id(id);
    message.mutable_hello()->set_slots(1);
    message.mutable_hello()->set_host(host);
    message.mutable_hello()->set_engine_version(engine);
    say(message, peer);
  }
  void goodbye(PeerId peer) {
    pb::ToCoordinator message;
    message.set_incarnation(1);
    message.mutable_goodbye();
    say(message, peer);
  }
  /// A tick, and all that follows.
  void move(Duration time = std::chrono::milliseconds(100)) {
    now += time;
    coordinator.on_tick(now);
    for (CoordinatorAction& action : coordinator.take_actions(now)) {
      if (auto* send = std::get_if<SendFrame>(&action)) {
        ++sent;
        bytes_sent += send->frame.size();
        frames.push_back(std::move(send->frame));
      }
      auto* append = std::get_if<AppendRows>(&action);
      if (append == nullptr) continue;
      for (const Row& row : append->rows) {
        if (const auto* worker = std::get_if<WorkerRow>(&row)) {
          workers[worker->id] = *worker;
          bytes_written += bytes_of(*worker);
        } else if (const auto* event = std::get_if<EventRow>(&row)) {
          ++events[event->kind];
          bytes_written += bytes_of(*event);
        } else if (std::holds_alternative<FailureRow>(row)) {
          ++failures;
        }
      }
      coordinator.on_appended(0, ++ticket);
    }
  }

  cluster::CampaignShape shape;
  SyntheticCampaign campaign{shape};
  FlatCampaign flat{programs_of(kPrograms)};
  CoordinatorOptions options;
  Coordinator coordinator;
  std::string address = "10.0.0.7";
  TimePoint now{std::chrono::seconds(50)};
  std::map<WorkerNumber, WorkerRow> workers;
  std::map<std::string, int> events;
  std::vector<std::string> frames;
  std::size_t failures = 0;
  std::size_t bytes_written = 0;
  std::size_t bytes_sent = 0;
  std::size_t sent = 0;
  std::uint64_t ticket = 0;
};

/// A hundred thousand, over a minute and a half.
TEST_F(Guests, WhoComeAndGoUnderNewNamesTakeLittle) {
  for (PeerId peer = 1; peer <= 100'000; ++peer) {
    hello(peer, std::string(200, 'h'));
    goodbye(peer);
    if (peer % 100 == 0) move();
  }
  EXPECT_LT(bytes_written, 500'000U);
  EXPECT_LT(coordinator.scheduler().workers().all().size(), 4000U);
  EXPECT_GT(coordinator.status().over_budget.at("hello"), 50'000U);
  EXPECT_GE(events["over budget"], 2);
  EXPECT_LE(events["over budget"], 10);
}

TEST_F(Guests, WhoAreRefusedTakeLittle) {
  for (PeerId peer = 1; peer <= 100'000; ++peer) {
    hello(peer, std::string(200, 'h'), 5000);
    if (peer % 100 == 0) move();
  }
  EXPECT_LT(bytes_written, 500'000U);
  EXPECT_GT(events["worker refused"], 10);
}

TEST_F(Guests, WhoAskForAScenarioAgainAndAgainGetItSeldom) {
  for (PeerId peer = 1; peer <= 20; ++peer)
    hello(peer);
  for (int i = 0; i < 100; ++i) {
    for (PeerId peer = 1; peer <= 20; ++peer) {
      pb::ToCoordinator message;
      message.set_incarnation(1);
      message.mutable_want_scenario();
      say(message, peer);
    }
  }
  move();
  EXPECT_GE(bytes_sent, 16U << 20U);
  EXPECT_LE(bytes_sent, 40U << 20U);
}

TEST_F(Guests, AClusterBehindOneAddressIsWelcomedAtOnceAndWrittenInTime) {
  for (PeerId peer = 1; peer <= kNodes; ++peer)
    hello(peer, "node" + std::to_string(peer));
  move();
  EXPECT_EQ(coordinator.scheduler().workers().connected(), kNodes);
  EXPECT_EQ(sent, kNodes);
  // Its workers are alive meanwhile.
  for (int second = 0; second < 1500 && workers.size() < kNodes; ++second) {
    for (PeerId peer = 1; peer <= kNodes; ++peer) {
      pb::ToCoordinator message;
      message.set_incarnation(1);
      message.mutable_heartbeat();
      say(message, peer);
    }
    move(std::chrono::seconds(1));
  }
  EXPECT_EQ(workers.size(), kNodes);
  EXPECT_EQ(coordinator.status().over_budget.size(), 0U);
}

TEST_F(Guests, AHelloThatWasNotHeardIsHeardLater) {
  for (int i = 0; i < 100; ++i)
    hello(1);
  for (PeerId peer = 2; peer <= 5000; ++peer)
    hello(peer);
  const std::size_t before = coordinator.scheduler().workers().connected();
  EXPECT_LT(before, 4001U);
  move(std::chrono::seconds(1));
  hello(5001);
  EXPECT_EQ(coordinator.scheduler().workers().connected(), before + 1);
}

class GuestsWithPrograms : public Guests {
 protected:
  GuestsWithPrograms() : Guests(true) {}

  /// Says of all that it was given why it failed.
  void fail(PeerId peer) {
    pb::ToCoordinator answer;
    answer.set_incarnation(1);
    for (const std::string& frame : std::exchange(frames, {})) {
      google::protobuf::Arena arena;
      const auto message = value_of(decode_to_worker(frame, arena));
      if (!message->has_tasks()) continue;
      answer.mutable_results()->set_scenario(message->tasks().scenario());
      for (const pb::Task& task : message->tasks().tasks()) {
        pb::Result& result = *answer.mutable_results()->add_results();
        *result.mutable_key() = task.key();
        result.set_attempt(task.attempt());
        result.set_signature(task.signature());
        result.set_failure("exit code 1");
        result.set_errors(std::string(3000, 'e'));
      }
    }
    if (answer.has_results()) say(answer, peer);
  }
};

/// Three times what a stranger may have written, and its hello besides.
TEST_F(GuestsWithPrograms, WhyAProgramFailedIsAlwaysWritten) {
  hello(1);
  move();
  for (int turn = 0; turn < 1000 && !flat.finished(); ++turn) {
    pb::ToCoordinator more;
    more.set_incarnation(1);
    more.mutable_credit()->set_tasks(50);
    more.set_sequence(static_cast<std::uint64_t>(turn) + 1);
    say(more, 1);
    move();
    fail(1);
    move();
  }
  EXPECT_TRUE(flat.finished());
  EXPECT_EQ(failures, static_cast<std::size_t>(kPrograms));
  EXPECT_EQ(coordinator.status().over_budget.count("failure"), 0U);
}

}  // namespace
}  // namespace swarmsmith
