#include "worker/pool.h"

#include <unistd.h>
#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <limits>
#include <map>
#include <semaphore>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "proto/frame_pipe.h"
#include "proto/task_messages.h"
#include "proto/wakeup.h"
#include "proto/wire.h"
#include "proto/wire.pb.h"
#include "tests/support/checks.h"
#include "worker/referee.h"
#include "worker/service.h"

namespace swarmsmith {
namespace {

/// Does what the item's machine says.
Expected<Evaluator> make_obedient(const std::string& scenario) {
  if (scenario == "bad") return bad_input("a bad scenario");
  return Evaluator([](const LeasedTask& item) -> Result {
    if (item.machine == "throw") throw std::runtime_error("thrown");
    if (item.machine == "error") return Result{.failure = "an error"};
    if (item.machine == "nan")
      return Result{.measured = {.score = std::numeric_limits<double>::quiet_NaN()}};
    if (item.machine == "large") return Result{.measured = {.score = -1.01e300}};
    if (item.machine == "largest") return Result{.measured = {.score = -1e300}};
    return Result{.measured = {.score = static_cast<double>(item.seed) * 2, .state_digest = 9}};
  });
}

std::vector<LeasedTask> items(int count, const std::string& machine = "") {
  std::vector<LeasedTask> made;
  for (int i = 1; i <= count; ++i) {
    LeasedTask item;
    item.key = static_cast<PackedKey>(i);
    item.seed = i;
    item.machine = machine;
    made.push_back(item);
  }
  return made;
}

class Pools : public ::testing::Test {
 protected:
  std::map<PackedKey, Result> wait_for(Pool& pool, std::size_t count) {
    std::map<PackedKey, Result> results;
    while (results.size() < count) {
      if (!woken.try_acquire_for(std::chrono::milliseconds(2)) && ++tries > 10'000) break;
      for (PoolEvent& event : pool.take_events()) {
        if (auto* result = std::get_if<Result>(&event)) results[result->key] = *result;
      }
    }
    return results;
  }

  std::counting_semaphore<> woken{0};
  int tries = 0;
};

TEST_F(Pools, EvaluateEveryItem) {
  Pool pool(3, make_obedient, [this] { woken.release(); });
  ASSERT_TRUE(pool.use("fine"));
  pool.run(items(500));
  const auto results = wait_for(pool, 500);
  ASSERT_EQ(results.size(), 500U);
  EXPECT_EQ(results.at(250).measured.score, 500);
  EXPECT_EQ(results.at(250).failure, "");
}

TEST_F(Pools, TurnTroubleIntoFailures) {
  Pool pool(1, make_obedient, [this] { woken.release(); });
  ASSERT_TRUE(pool.use("fine"));
  for (const auto& [machine, text] : std::map<std::string, std::string>{
           {"throw", "thrown"}, {"error", "an error"}, {"nan", "the score is not finite"}}) {
    pool.run(items(1, machine));
    EXPECT_EQ(wait_for(pool, 1).at(1).failure, text);
  }
}

/// The coordinator refuses the whole message with such a score, and the worker would send it again
/// for ever.
TEST_F(Pools, TurnScoresThatCannotBeSentIntoFailures) {
  Pool pool(1, make_obedient, [this] { woken.release(); });
  ASSERT_TRUE(pool.use("fine"));
  pool.run(items(1, "large"));
  const Result large = wait_for(pool, 1).at(1);
  EXPECT_EQ(large.failure, "the score is beyond 1e300");
  EXPECT_EQ(large.measured.score, 0);
  pool.run(items(1, "largest"));
  EXPECT_EQ(wait_for(pool, 1).at(1).failure, "");
}

TEST_F(Pools, GiveBackWhatIsNotStarted) {
  std::binary_semaphore started{0};
  std::binary_semaphore go{0};
  Pool pool(
      1,
      [&](const std::string&) -> Expected<Evaluator> {
        return Evaluator([&](const LeasedTask&) -> Result {
          started.release();
          go.acquire();
          return Result{.measured = {.score = 1, .state_digest = 1}};
        });
      },
      [this] { woken.release(); });
  ASSERT_TRUE(pool.use("fine"));
  pool.run(items(5));
  started.acquire();
  EXPECT_EQ(pool.take_back(), (std::vector<PackedKey>{2, 3, 4, 5}));
  go.release();
  EXPECT_EQ(wait_for(pool, 1).size(), 1U);
}

/// One slot, whose items wait until `go`; each says when it has begun.
class GatedSlot : public Pools {
 protected:
  void TearDown() override { go.release(1000); }  // more than there are items

  /// Lets the running item end. All that the slot does for it is done when the next one begins.
  void finish_one() {
    go.release();
    started.acquire();
  }
  int wakes() {
    int count = 0;
    while (woken.try_acquire())
      ++count;
    return count;
  }
  std::vector<std::string> events() {
    std::vector<std::string> lines;
    for (const PoolEvent& event : pool.take_events()) {
      const auto* result = std::get_if<Result>(&event);
      lines.push_back(result == nullptr
                          ? "start " + std::to_string(std::get<ItemStarted>(event).key)
                          : "end " + std::to_string(result->key) + " " + result->failure);
    }
    return lines;
  }

  std::counting_semaphore<> started{0};
  std::counting_semaphore<> go{0};
  Pool pool{1,
            [&](const std::string& scenario) -> Expected<Evaluator> {
              return Evaluator([&, scenario](const LeasedTask&) -> Result {
                started.release();
                go.acquire();
                return Result{.failure = scenario};
              });
            },
            [this] { woken.release(); }};
};

/// For the first result, not for later ones while the owner comes by itself, for as many as may
/// wait, and when the slot is about to run out.
TEST_F(GatedSlot, WakesItsOwnerWhenItShouldCome) {
  ASSERT_TRUE(pool.use("s"));
  pool.run(items(200));
  started.acquire();
  EXPECT_THAT(events(), ElementsAre("start 1"));
  finish_one();
  EXPECT_EQ(wakes(), 1) << "the first";
  finish_one();
  EXPECT_EQ(wakes(), 0) << "the owner has not come yet";
  EXPECT_THAT(events(), ElementsAre("end 1 s", "start 2", "end 2 s", "start 3"));
  for (std::size_t i = 1; i < Pool::kMaxWaiting; ++i)
    finish_one();
  EXPECT_EQ(wakes(), 0) << "the owner comes by itself";
  finish_one();
  EXPECT_EQ(wakes(), 1) << "too many wait";
  finish_one();
  EXPECT_EQ(wakes(), 0);
  EXPECT_EQ(events().size(), 2 * Pool::kMaxWaiting + 2);
  EXPECT_THAT(events(), IsEmpty());
  finish_one();
  EXPECT_EQ(wakes(), 1) << "the first after the owner came in vain";
  EXPECT_EQ(events().size(), 2U);
  EXPECT_EQ(pool.take_back().size(), 200U - 69U);
  pool.run(items(3));
  finish_one();
  finish_one();
  EXPECT_EQ(wakes(), 0) << "two are left for one slot";
  finish_one();
  EXPECT_EQ(wakes(), 1) << "one is left";
  go.release();
  EXPECT_TRUE(woken.try_acquire_for(std::chrono::seconds(10))) << "none is left";
}

TEST_F(GatedSlot, DropsWhatBelongsToAnotherScenario) {
  ASSERT_TRUE(pool.use("one"));
  pool.run(items(3));
  started.acquire();
  finish_one();
  ASSERT_TRUE(pool.use("two"));
  EXPECT_THAT(pool.take_back(), IsEmpty());
  EXPECT_THAT(events(), IsEmpty());
  wakes();
  pool.run(items(3));
  finish_one();
  EXPECT_EQ(wakes(), 0) << "not for the result that is dropped";
  EXPECT_THAT(events(), ElementsAre("start 1"));
  finish_one();
  EXPECT_EQ(wakes(), 1);
  EXPECT_THAT(events(), ElementsAre("end 1 two", "start 2"));
}

TEST(EvaluatedItem, IsTheAnswerToItsLease) {
  LeasedTask item;
  item.key = 5;
  item.attempt = 6;
  item.signature = 7;
  const auto long_for_2_ms = [](const LeasedTask&) -> Result {
    const auto begin = std::chrono::steady_clock::now();
    while (std::chrono::steady_clock::now() - begin < std::chrono::milliseconds(2)) {
    }
    return {.key = 1, .attempt = 2, .measured = {.score = 4, .wall_us = -1}, .signature = 3};
  };
  const Result result = evaluate(long_for_2_ms, item);
  EXPECT_EQ(std::tuple(result.key, result.attempt, result.signature), std::tuple(5U, 6, 7U));
  EXPECT_EQ(result.measured.score, 4);
  EXPECT_GE(result.measured.wall_us, 2000);
  EXPECT_LT(result.measured.wall_us, 60'000'000);
  const Result strange = evaluate([](const LeasedTask&) -> Result { throw 1; }, item);
  EXPECT_EQ(strange.failure, "an exception without a text");
  EXPECT_EQ(strange.key, 5U);
}

TEST(WorkerLoop, GivesUpWithTheReasonWhyItFoundNoCoordinator) {
  Pool pool(1, make_obedient, [] {});
  Wakeup wakeup;
  const std::atomic<bool> drain{false};
  int finds = 0;
  std::vector<bool> connected;
  WorkerServiceOptions options{.endpoint = "tcp://127.0.0.1:1"};
  options.find = [&]() -> Expected<CoordinatorAddress> {
    ++finds;
    return bad_input(finds < 2 ? "no file yet" : "a strange file");
  };
  options.on_connected = [&](bool is) { connected.push_back(is); };
  options.protocol.first_backoff = std::chrono::milliseconds(1);
  options.protocol.longest_backoff = std::chrono::milliseconds(1);
  options.protocol.give_up_after = std::chrono::milliseconds(300);  // for a busy machine, too
  ::testing::internal::CaptureStderr();
  const WorkerEnd end =
      serve(options, {.id = std::string(kWorkerIdBytes, 'w')}, pool, wakeup, drain);
  const std::string log = ::testing::internal::GetCapturedStderr();
  EXPECT_EQ(end.code, WorkerExit::Unreachable);
  EXPECT_EQ(end.reason, "no coordinator for too long: a strange file");
  EXPECT_GE(finds, 2);
  EXPECT_THAT(connected, IsEmpty());
  const auto count = [&](const std::string& part) {
    int found = 0;
    for (std::size_t at = log.find(part); at != std::string::npos; at = log.find(part, at + 1))
      ++found;
    return found;
  };
  EXPECT_EQ(count("cannot connect; trying again"), 2) << "each reason once:\n" << log;
  EXPECT_EQ(count("no file yet"), 1);
  EXPECT_EQ(count("a strange file"), 1);
}

/// Frames of a referee's pipes: what comes in, and after the end what went out.
class Referee : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(pipe(in.data()), 0);
    ASSERT_EQ(pipe(out.data()), 0);
  }
  ~Referee() override {
    for (const int descriptor : {in[0], out[0]})
      close(descriptor);
  }
  void say_scenario(const std::string& scenario) {
    pb::ToWorker message;
    message.mutable_scenario()->set_scenario(scenario);
    ASSERT_TRUE(write_frame(in[1], encode(message)));
  }
  void say_tasks(const std::vector<LeasedTask>& tasks) {
    pb::ToWorker message;
    for (const LeasedTask& task : tasks)
      write(task, *message.mutable_tasks()->add_tasks());
    ASSERT_TRUE(write_frame(in[1], encode(message)));
  }
  int serve() {
    close(in[1]);
    const int code =
        serve_as_referee({.build = "b", .engine_version = 3, .self_test = "bits", .slots = 9},
                         make_obedient, in[0], out[1]);
    close(out[1]);
    std::string frame;
    google::protobuf::Arena arena;
    while (read_frame(out[0], kMaxFrameBytes, frame)) {
      pb::ToCoordinator message = *value_of(decode_to_coordinator(frame, arena));
      if (message.has_results()) {
        for (pb::Result& result : *message.mutable_results()->mutable_results())
          result.clear_wall_us();
      }
      said.push_back(message.ShortDebugString());
    }
    return code;
  }

  std::array<int, 2> in{};
  std::array<int, 2> out{};
  std::vector<std::string> said;
};

std::string no_id() {
  std::string text;
  for (std::size_t i = 0; i < kWorkerIdBytes; ++i)
    text += "\\000";
  return text;
}

const std::string kRefereeHello =
    "hello { worker_id: \"" + no_id() + "\" engine_version: 3 self_test: \"bits\" slots: 1 }";

TEST_F(Referee, SaysWhatItBeginsAndWhatCameOfIt) {
  say_scenario("fine");
  LeasedTask one;
  one.key = pack(3, 2, 4);
  one.seed = 21;
  one.attempt = 8;
  LeasedTask other = one;
  other.key = pack(4, 0, 1);
  other.machine = "error";
  say_tasks({one, other});
  say_tasks({one});
  EXPECT_EQ(serve(), 0);
  const std::string key = "key { candidate: 3 purpose: 2 pair: 4 }";
  const std::string result =
      "results { results { " + key + " attempt: 8 score: 42 state_digest: 9 } }";
  EXPECT_THAT(said, ElementsAre(kRefereeHello, "began { " + key + " }", result,
                                "began { key { candidate: 4 pair: 1 } }",
                                "results { results { key { candidate: 4 pair: 1 } attempt: 8 "
                                "failure: \"an error\" } }",
                                "began { " + key + " }", result));
}

TEST_F(Referee, RefusesAScenarioThatItCannotRun) {
  say_scenario("bad");
  say_tasks(items(1));
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(serve(), 7);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "a bad scenario\n");
  EXPECT_THAT(said, ElementsAre(kRefereeHello));
}

TEST_F(Referee, RefusesTasksWithoutAScenario) {
  say_tasks(items(1));
  EXPECT_EQ(serve(), 2);
  EXPECT_THAT(said, ElementsAre(kRefereeHello));
}

TEST_F(Referee, RefusesRubbish) {
  ASSERT_TRUE(write_frame(in[1], "rubbish"));
  EXPECT_EQ(serve(), 2);
  EXPECT_THAT(said, ElementsAre(kRefereeHello));
}

TEST_F(Referee, EndsWhenItCannotWrite) {
  const auto before = std::signal(SIGPIPE, SIG_IGN);
  say_scenario("fine");
  say_tasks(items(2));
  // The end for reading takes nothing.
  EXPECT_EQ(serve_as_referee({}, make_obedient, in[0], in[0]), 1);
  std::signal(SIGPIPE, before);
  close(in[1]);
  close(out[1]);
}

/// A long task on every slot, and more than the slots waiting: the first result does not wait for
/// the others.
TEST_F(Pools, WakeForTheFirstResultThoughThereIsMuchWorkLeft) {
  std::counting_semaphore<> go{0};
  Pool pool(
      2,
      [&](const std::string&) -> Expected<Evaluator> {
        return Evaluator([&](const LeasedTask&) -> Result {
          go.acquire();
          return Result{.measured = {.score = 1}};
        });
      },
      [this] { woken.release(); });
  ASSERT_TRUE(pool.use("fine"));
  pool.run(items(20));
  go.release();
  EXPECT_TRUE(woken.try_acquire_for(std::chrono::seconds(60)));
  go.release(19);
  EXPECT_EQ(wait_for(pool, 20).size(), 20U);
}

TEST_F(Pools, SayWhyAScenarioCannotBeUsed) {
  Pool pool(1, make_obedient, [] {});
  EXPECT_EQ(why_not(pool.use("bad")).message, "a bad scenario");
}

}  // namespace
}  // namespace swarmsmith
