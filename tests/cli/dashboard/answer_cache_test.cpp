#include "cli/dashboard/answer_cache.h"

#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <latch>
#include <thread>
#include <vector>

namespace swarmsmith::cli {
namespace {

using Time = AnswerCache::Clock::time_point;
/// Any answer is young enough, or none that there is.
constexpr Time kAny = Time::min();
constexpr Time kNone = Time::max();

KeptAnswer of(const std::string& bytes) {
  KeptAnswer answer;
  answer.packed = bytes;
  return answer;
}

std::string get(AnswerCache& cache, const std::string& question, const std::string& stamp,
                const KeptAnswer& fresh, Time oldest = kNone) {
  bool shared = false;
  return cache
      .get(
          question, stamp, oldest, [&] { return fresh; }, shared)
      ->packed;
}

TEST(AnswerCacheTest, AnswersOfTheSameStampAreKept) {
  AnswerCache cache(1 << 20);
  EXPECT_EQ(get(cache, "race", "1", of("a")), "a");
  EXPECT_EQ(get(cache, "race", "1", of("b")), "a");
  EXPECT_EQ(get(cache, "race", "2", of("b")), "b") << "the store has moved on";
  EXPECT_EQ(get(cache, "race", "", of("c")), "c") << "the store moves";
  EXPECT_EQ(get(cache, "race", "", of("d")), "d");
}

TEST(AnswerCacheTest, YoungAndFinalAnswersAreKept) {
  AnswerCache cache(1 << 20);
  EXPECT_EQ(get(cache, "live", "", of("a"), kAny), "a");
  EXPECT_EQ(get(cache, "live", "", of("b"), kAny), "a");
  KeptAnswer last = of("over");
  last.is_final = true;
  EXPECT_EQ(get(cache, "race 3", "1", last), "over");
  EXPECT_EQ(get(cache, "race 3", "2", of("b")), "over");
  cache.forget();
  EXPECT_EQ(get(cache, "live", "", of("b"), kAny), "b");
  EXPECT_EQ(get(cache, "race 3", "3", of("b")), "over");
}

TEST(AnswerCacheTest, ErrorsAreNotKept) {
  AnswerCache cache(1 << 20);
  KeptAnswer error = of("no");
  error.is_good = false;
  EXPECT_EQ(get(cache, "race", "1", error, kAny), "no");
  EXPECT_EQ(get(cache, "race", "1", of("yes"), kAny), "yes");
}

TEST(AnswerCacheTest, WhatWasNotAskedForGoesFirst) {
  AnswerCache cache(10'000);
  const std::string large(4'000, 'x');
  get(cache, "1", "s", of(large));
  get(cache, "2", "s", of(large));
  get(cache, "1", "s", of("again"));
  get(cache, "3", "s", of(large));
  EXPECT_EQ(get(cache, "1", "s", of("new")), large);
  EXPECT_EQ(get(cache, "2", "s", of("new")), "new");
}

TEST(AnswerCacheTest, EqualQuestionsShareOneComputation) {
  AnswerCache cache(1 << 20);
  constexpr int kAskers = 8;
  std::atomic<int> made = 0;
  std::atomic<int> shared_by = 0;
  std::latch begun(1);
  std::latch others(kAskers - 1);
  const auto ask = [&](bool first) {
    bool shared = false;
    if (!first) {
      begun.wait();
      others.count_down();
    }
    const auto answer = cache.get(
        "race", "", kAny,
        [&] {
          ++made;
          begun.count_down();
          // They ask while this is under way, or find it kept.
          others.wait();
          return of("a");
        },
        shared);
    if (shared) ++shared_by;
    EXPECT_EQ(answer->packed, "a");
  };
  std::vector<std::jthread> askers;
  askers.emplace_back(ask, true);
  for (int i = 1; i < kAskers; ++i)
    askers.emplace_back(ask, false);
  askers.clear();
  EXPECT_EQ(made, 1);
  EXPECT_EQ(shared_by, kAskers - 1);
}

TEST(AnswerCacheTest, AnswersThatBeganTooEarlyAreNotShared) {
  AnswerCache cache(1 << 20);
  std::string inner;
  const auto before = AnswerCache::Clock::now();
  bool shared = false;
  cache.get(
      "race", "", kNone,
      [&] {
        inner = get(cache, "race", "", of("newer"), kNone);
        return of("older");
      },
      shared);
  EXPECT_EQ(inner, "newer") << "it asked after something had been told";
  EXPECT_EQ(get(cache, "race", "", of("other"), before), "newer");
  EXPECT_EQ(get(cache, "race", "", of("newest"), AnswerCache::Clock::now()), "newest");
}

/// Asks until it is there.
AnswerCache::SoFar get_at_once(AnswerCache& cache, const std::function<KeptAnswer()>& make) {
  return cache.get_within("figure", "", kNone, make, std::make_shared<std::atomic<bool>>(true),
                          std::chrono::milliseconds(0));
}

TEST(AnswerCacheTest, WhatTakesLongIsFetchedLater) {
  AnswerCache cache(1 << 20);
  std::latch may_end(1);
  std::atomic<int> made = 0;
  const auto make = [&] {
    ++made;
    may_end.wait();
    KeptAnswer answer = of("drawn");
    answer.is_good = false;  // what cannot be drawn is said, too
    answer.seconds = 43;
    return answer;
  };
  const AnswerCache::SoFar first = get_at_once(cache, make);
  EXPECT_EQ(first.answer, nullptr);
  EXPECT_TRUE(first.goes_on);
  EXPECT_FALSE(first.shared);
  const AnswerCache::SoFar second = get_at_once(cache, make);
  EXPECT_EQ(second.answer, nullptr);
  EXPECT_TRUE(second.shared);
  EXPECT_GE(second.seconds, first.seconds);
  may_end.count_down();
  cache.wait_for_all();
  // The store has gone on meanwhile: no stamp, and nothing is young enough.
  const AnswerCache::SoFar there = get_at_once(cache, make);
  ASSERT_NE(there.answer, nullptr);
  EXPECT_EQ(there.answer->packed, "drawn");
  EXPECT_EQ(there.seconds, 43);
  EXPECT_EQ(made, 1);
}

TEST(AnswerCacheTest, WhatIsThereInTimeIsAnAnswerAsEver) {
  AnswerCache cache(1 << 20);
  const auto turn = std::make_shared<std::atomic<bool>>(true);
  const auto in_time = [&](const std::string& bytes) {
    return cache.get_within(
        "race", "1", kNone, [bytes] { return of(bytes); }, turn, std::chrono::hours(1));
  };
  EXPECT_EQ(in_time("a").answer->packed, "a");
  EXPECT_EQ(in_time("b").answer->packed, "a") << "the same stamp";
  cache.forget();
  EXPECT_EQ(in_time("c").answer->packed, "c");
}

TEST(TurnstileTest, WaitsSoLongAndNoLonger) {
  Turnstile turnstile(1, 4);
  const auto inside = turnstile.enter();
  EXPECT_FALSE(turnstile.enter(std::chrono::milliseconds(1)).has_value());
  std::jthread waiting([&] { EXPECT_FALSE(turnstile.enter().has_value()); });
  while (turnstile.waiting() == 0)
    std::this_thread::yield();
  turnstile.close();
  waiting.join();
  EXPECT_FALSE(turnstile.enter().has_value());
}

TEST(TurnstileTest, SomePassSomeWaitOthersAreTurnedAway) {
  Turnstile turnstile(2, 1);
  auto first = turnstile.enter();
  auto second = turnstile.enter();
  ASSERT_TRUE(first.has_value());
  ASSERT_TRUE(second.has_value());
  std::atomic<bool> inside = false;
  std::jthread waiting([&] {
    const auto pass = turnstile.enter();
    inside = pass.has_value();
  });
  // This one takes the only place to wait: from then on all others are refused.
  while (turnstile.waiting() == 0)
    std::this_thread::yield();
  EXPECT_FALSE(turnstile.enter().has_value());
  EXPECT_FALSE(inside);
  first.reset();
  waiting.join();
  EXPECT_TRUE(inside);
  second.reset();
  EXPECT_TRUE(turnstile.enter().has_value());
}

}  // namespace
}  // namespace swarmsmith::cli
