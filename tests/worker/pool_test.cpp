#include "worker/pool.h"

#include <atomic>
#include <chrono>
#include <limits>
#include <map>
#include <semaphore>
#include <set>
#include <stdexcept>

#include "tests/support/checks.h"

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
