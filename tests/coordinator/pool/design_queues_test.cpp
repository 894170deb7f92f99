#include "coordinator/pool/design_queues.h"

#include <gtest/gtest.h>
#include <cmath>
#include <vector>

namespace swarmsmith {
namespace {

constexpr auto kAny = [](PackedKey) { return true; };

class Queues : public ::testing::Test {
 protected:
  DesignQueues::Design& design(std::int64_t number, std::uint32_t campaign = 0) {
    return queues.design({campaign, number});
  }
  void want(std::int64_t number, int count, std::uint32_t campaign = 0) {
    for (int i = 0; i < count; ++i) {
      const std::int64_t candidate = (number - 1) * kMostCandidates + ++made;
      queues.push_back(design(number, campaign), false, pack(candidate, 1, 1, campaign));
    }
  }
  /// Leases what comes next; its design, or 0.
  PoolDesign lease(std::size_t free = 0, std::uint64_t cost_us = 100,
                   std::uint64_t allowance_us = 0) {
    const auto key = queues.next(free, allowance_us, kAny);
    if (!key) return {};
    DesignQueues::Design& from = queues.design(pool_design_of(*key));
    queues.on_leased(from, false, cost_us);
    queues.erase(from, false, from.wanted.begin());
    return from.id;
  }

  DesignQueues queues;
  std::int64_t made = 0;
};

TEST_F(Queues, GiveEachDesignTheSame) {
  for (std::int64_t number = 1; number <= 30; ++number)
    want(number, 50);
  for (int i = 0; i < 600; ++i) {
    lease();
    std::size_t least = 50;
    std::size_t most = 0;
    for (const auto& [id, it] : queues.all()) {
      least = std::min(least, it.wanted_leased);
      most = std::max(most, it.wanted_leased);
    }
    ASSERT_LE(most - least, 1U);
  }
}

TEST_F(Queues, ShareTimeAndNotTasks) {
  want(1, 2000, 0);
  want(1, 2000, 1);
  for (int i = 0; i < 1000; ++i) {
    const auto next = queues.next(0, 0, kAny);
    lease(0, campaign_of(*next) == 0 ? 2000 : 50'000);
  }
  const double short_ones = static_cast<double>(design(1, 0).wanted_leased);
  const double long_ones = static_cast<double>(design(1, 1).wanted_leased);
  EXPECT_NEAR(short_ones / long_ones, 25, 1);
}

TEST_F(Queues, LetNoDesignSaveUpAShare) {
  want(1, 200);
  for (int i = 0; i < 100; ++i)
    lease();
  want(2, 100);  // it had nothing so far, and does not get it all now
  int of_the_second = 0;
  for (int i = 0; i < 20; ++i)
    of_the_second += lease().design == 2;
  EXPECT_NEAR(of_the_second, 10, 1);
}

TEST_F(Queues, PreferWhoIsNextToABarrier) {
  want(1, 10);
  want(2, 3);
  EXPECT_EQ(lease(0).design, 1);
  EXPECT_EQ(lease(2).design, 2) << "its turn";
  EXPECT_EQ(lease(2).design, 2) << "the rest of it fits, and it had no more than the other";
  EXPECT_EQ(lease(1).design, 1) << "now it had more, and nothing is lent";
  EXPECT_EQ(lease(1, 100, 1000).design, 2);
}

TEST_F(Queues, PreferTheFewestOutstandingAmongThose) {
  want(1, 4);
  lease();
  lease();
  lease();
  want(2, 2);
  // One is queued of the first and two of the second, but the first waits for three more.
  EXPECT_EQ(lease(2, 100, 10'000).design, 2);
}

TEST_F(Queues, BoundWhatUrgencyGets) {
  want(2, 2000);
  for (int i = 0; i < 1000; ++i) {
    if (design(1).wanted.empty()) want(1, 1);  // always next to a barrier
    lease(1, 100, 500);
    ASSERT_LE(design(1).had_us, design(2).had_us + 500 + 100);
  }
  EXPECT_GE(design(2).wanted_leased, 490U);
}

/// Two slots, and designs whose steps have so many tasks of one time unit each; the time until all
/// is done.
int makespan(bool with_urgency) {
  const std::vector<std::vector<int>> steps = {{3, 1, 1}, {3}};
  std::vector<std::size_t> step(steps.size(), 0);
  std::vector<int> waiting(steps.size(), 0);
  DesignQueues queues;
  PackedKey made = 0;
  const auto ask = [&](std::size_t i) {
    waiting[i] = steps[i][step[i]++];
    for (int task = 0; task < waiting[i]; ++task) {
      const auto candidate =
          static_cast<std::int64_t>(i) * kMostCandidates + static_cast<std::int64_t>(++made);
      queues.push_back(queues.design(pool_design_of(pack(candidate, 1, 1))), false,
                       pack(candidate, 1, 1));
    }
  };
  for (std::size_t i = 0; i < steps.size(); ++i)
    ask(i);
  for (int time = 0;; ++time) {
    std::vector<std::size_t> running;
    for (std::size_t free = 2; free > 0; --free) {
      const auto key = queues.next(with_urgency ? free : 0, 10, kAny);
      if (!key) break;
      DesignQueues::Design& from = queues.design(pool_design_of(*key));
      queues.on_leased(from, false, 1);
      queues.erase(from, false, from.wanted.begin());
      running.push_back(static_cast<std::size_t>(from.id.design - 1));
    }
    if (running.empty()) return time;
    for (const std::size_t i : running) {
      queues.on_unleased(queues.design({0, static_cast<std::int64_t>(i) + 1}), false);
      if (--waiting[i] == 0 && step[i] < steps[i].size()) ask(i);
    }
  }
}

TEST(QueueOrder, BarriersFirstShortensTheWhole) {
  EXPECT_EQ(makespan(false), 5);
  EXPECT_EQ(makespan(true), 4);
}

TEST_F(Queues, GiveNothingOfWhatIsHeld) {
  want(1, 2, 0);
  want(1, 2, 1);
  queues.hold({0, 1}, true);
  EXPECT_EQ(lease(), (PoolDesign{1, 1}));
  queues.hold({1, 0}, true);
  EXPECT_EQ(lease(), PoolDesign{});
  EXPECT_EQ(queues.wanted(), 0U);
  want(2, 1, 1);  // a design that was not there when its campaign was held
  EXPECT_EQ(lease(), PoolDesign{});
  queues.hold({1, 0}, false);
  EXPECT_EQ(queues.wanted(), 2U);
  EXPECT_EQ(queues.wanted_of({1, 0}), 2U);
  EXPECT_EQ(queues.wanted_of({1, 1}), 1U);
  queues.hold({0, 1}, false);
  EXPECT_EQ(queues.wanted(), 4U);
}

}  // namespace
}  // namespace swarmsmith
