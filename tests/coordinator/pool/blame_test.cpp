// Peers that come, take and leave change nothing.

#include <gmock/gmock.h>

#include <set>

#include "base/rng.h"
#include "tests/coordinator/pool/schedulers.h"

namespace swarmsmith {
namespace {

class Blame : public Schedulers {
 protected:
  void leave(PeerId peer, bool silent = false) {
    if (silent) now += seconds(3);
    lose(peer);
  }
};

TEST_F(Blame, StrangersThatTakeAndLeaveChangeNothing) {
  want(1, 30);
  for (PeerId peer = 10; peer < 60; ++peer) {
    enter(peer, "127.0.0.1", 1 + static_cast<int>(peer % 4));
    credit(peer, 1 + peer % 70);
    if (peer % 3 == 0 && !given[peer].empty()) {
      scheduler.on_began({peer, 1, 2}, key(given[peer][0]), now);
    }
    leave(peer, peer % 5 == 0);
  }
  EXPECT_TRUE(all<OutcomeAccepted>().empty());
  EXPECT_TRUE(all<StopCampaign>().empty());
  // Nothing is slower for those who work: nothing has to run alone.
  hello(1, 4);
  credit(1, 100);
  for (int i = 0; i < 40; ++i) {
    for (const std::int64_t candidate : std::exchange(given[1], {}))
      answer(1, candidate);
  }
  while (const auto key = asked())
    rule_score(unpack(*key).candidate.value);
  EXPECT_EQ(all<OutcomeAccepted>().size(), 30U);
  EXPECT_EQ(scheduler.counters().rejected, 0U);
}

TEST_F(Blame, TheRefereeBreaksTheCircleWhereEveryNewcomerDies) {
  want(1, 1);
  for (PeerId peer = 1; peer <= 20 && !asked(); ++peer) {
    enter(peer, "10.0.0.1");
    credit(peer, 1);
    leave(peer);
  }
  ASSERT_EQ(asked(), key(1));
  rule_rejected(1);
  ASSERT_EQ(all<OutcomeAccepted>().size(), 1U);
}

TEST_F(Blame, WhatMayHaveKilledAWorkerRunsOnProvenWorkersAlone) {
  hello(1);
  hello(2);
  credit(2, 0);
  credit(1, 100);
  want(1, 8);
  scheduler.on_unreachable(1, now + milliseconds(10));
  move();
  ASSERT_GE(given[1].size(), 2U);
  enter(3, "10.0.0.1");
  credit(3, 10);
  for (const std::int64_t candidate : given[1])
    EXPECT_THAT(given[3], testing::Not(testing::Contains(candidate)))
        << "its death would say nothing";
  credit(2, 100);
  EXPECT_EQ(given[2], (std::vector<std::int64_t>{given[1].front()}));
}

TEST_F(Blame, HalfOfTheWorkersAreKeptFreeForWhatRunsAlone) {
  hello(1);
  credit(1, 100);
  want(1, 40);
  lose(1);
  const std::vector<std::int64_t> alone = given[1];
  ASSERT_GT(alone.size(), 3U);
  std::int64_t begun = 0;
  for (PeerId peer = 2; peer <= 5; ++peer)
    hello(peer);
  for (PeerId peer = 2; peer <= 5; ++peer) {
    credit(peer, 1);
    if (!given[peer].empty()) begun += std::ranges::count(alone, given[peer].front());
  }
  EXPECT_EQ(begun, 2);
}

TEST_F(Blame, StrangersHaveTheRefereeDoOneThingAtATime) {
  want(1, 64);
  for (PeerId peer = 1; peer <= 30; ++peer) {
    enter(peer, "10.0.0.1", 64);
    credit(peer, 64);
    leave(peer);
  }
  EXPECT_EQ(scheduler.cases().size(), 1U);
}

/// Else a race waits for what they took, again and again.
TEST_F(Blame, StrangersThatTakeAndLeaveGetLittleWhileOthersWork) {
  hello(1, 1);
  want(1, 4000);
  const auto visits = [&](PeerId first, PeerId last) {
    std::size_t taken = 0;
    for (PeerId peer = first; peer <= last; ++peer) {
      enter(peer, "10.0.0.1", 1, peer);
      credit(peer, 10, peer);
      taken += given[peer].size();
      leave(peer);
      now += milliseconds(20);
    }
    return taken;
  };
  EXPECT_LE(visits(10, 200), 50U);
  EXPECT_EQ(visits(201, 400), 0U);
  // Others are not held back by it, nor is it for ever.
  enter(500, "10.0.0.2", 1, 500);
  credit(500, 10, 500);
  EXPECT_EQ(given[500].size(), 10U);
  now += seconds(50);
  enter(501, "10.0.0.1", 1, 501);
  credit(501, 10, 501);
  EXPECT_EQ(given[501].size(), 10U);
}

TEST_F(Blame, StrangersThatTakeAndKeepGetLittleWhileOthersWork) {
  hello(1, 1);
  want(1, 4000);
  std::size_t taken = 0;
  for (PeerId peer = 10; peer < 20; ++peer) {
    enter(peer, "10.0.0.1", 1, peer);
    credit(peer, 10, peer);
  }
  for (int second = 0; second < 30; ++second) {
    for (PeerId peer = 10; peer < 20; ++peer) {
      credit(peer, 10, peer);
      taken += std::exchange(given[peer], {}).size();
    }
    beat(1, {}, 0);
    pass(seconds(1));
  }
  EXPECT_GE(taken, 32U);
  EXPECT_LE(taken, 100U);
}

TEST_F(Blame, StrangersGetAllWhereThereIsNoOtherWorker) {
  want(1, 4000);
  for (PeerId peer = 10; peer <= 60; ++peer) {
    enter(peer, "10.0.0.1", 1, peer);
    credit(peer, 10, peer);
    EXPECT_EQ(given[peer].size(), 10U);
    leave(peer);
  }
}

TEST_F(Blame, ANewcomerHoldsLittle) {
  want(1, 4000);
  enter(1, "10.0.0.1", 4000);
  credit(1, 4000);
  EXPECT_EQ(given[1].size(), 64U);
}

class BlameOfPrograms : public Blame {
 protected:
  void SetUp() override {
    options.evaluates_programs = true;
    scheduler = Scheduler(options);
  }
  /// Until it has the task, and dies with it.
  void die(PeerId peer, std::int64_t candidate) {
    credit(peer, 1);
    ASSERT_FALSE(given[peer].empty());
    ASSERT_EQ(given[peer].back(), candidate);
    scheduler.on_began({peer, 1, 99}, key(candidate), now);
    leave(peer);
  }
};

TEST_F(BlameOfPrograms, CountsDeathsOfThoseWhoHaveProvedThemselves) {
  for (PeerId peer = 1; peer <= 6; ++peer) {
    enter(peer, "10.0.0." + std::to_string(peer));
    give(peer, 100 + peer);
    answer(peer, 100 + peer);
    credit(peer, 0);
  }
  want(1, 1);
  for (PeerId peer = 1; peer <= 5; ++peer) {
    EXPECT_EQ(scheduler.counters().rejected, 0U) << peer;
    die(peer, 1);
  }
  EXPECT_EQ(scheduler.counters().rejected, 1U);
}

TEST_F(BlameOfPrograms, StrangersCannotRejectByDying) {
  want(1, 1);
  for (PeerId peer = 1; peer <= 40; ++peer) {
    enter(peer, "10.0.0." + std::to_string(peer));
    die(peer, 1);
  }
  EXPECT_EQ(scheduler.counters().rejected, 0U);
  EXPECT_TRUE(all<StopCampaign>().empty());
}

TEST_F(BlameOfPrograms, OnePrincipalCannotRejectByDyingWhereThereAreOthers) {
  for (const bool others : {true, false}) {
    scheduler = Scheduler(options);
    given.clear();
    for (PeerId peer = 1; peer <= 2; ++peer) {
      enter(peer, peer == 1 && others ? "10.0.0.1" : "10.0.0.2");
      give(peer, 100 + peer);
      answer(peer, 100 + peer);
      credit(peer, 0);
    }
    want(1, 1);
    std::uint64_t incarnation = 1;
    for (int i = 0; i < 10 && scheduler.counters().rejected == 0; ++i) {
      const PeerId peer = 10 + static_cast<PeerId>(i);
      enter(peer, "10.0.0.2", 1, ++incarnation);
      credit(peer, 1, incarnation);
      ASSERT_FALSE(given[peer].empty());
      scheduler.on_began({peer, incarnation, 99}, key(1), now);
      leave(peer);
    }
    EXPECT_EQ(scheduler.counters().rejected, others ? 0U : 1U);
  }
}

}  // namespace
}  // namespace swarmsmith
