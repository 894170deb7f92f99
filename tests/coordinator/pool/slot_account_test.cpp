#include "coordinator/pool/slot_account.h"

#include <gtest/gtest.h>

#include "tests/coordinator/pool/schedulers.h"

namespace swarmsmith {
namespace {

/// Workers played by hand whose slots are accounted for.
class SlotAccounts : public Schedulers {
 protected:
  double idle(IdleCause cause) const {
    return account.since_start().idle[static_cast<std::size_t>(cause)];
  }
  /// A second of ten samples, then the worker's word about its slots since its welcome.
  void second(PeerId peer, std::int64_t slot_ms, std::int64_t busy_ms, std::uint32_t tasks = 100,
              Holding holding = Holding::No) {
    for (int i = 0; i < 10; ++i) {
      now += milliseconds(100);
      move();
      account.sample(scheduler, holding, now);
    }
    scheduler.on_heartbeat({peer, 1, ++sequence}, tasks, {}, now,
                           SlotReport{slot_ms * 1000, busy_ms * 1000});
    move();
    account.sample(scheduler, holding, now);
  }
  void expect_sum() const {
    const SlotTimes& times = account.since_start();
    EXPECT_NEAR(times.slots, times.busy + times.idle_total(), 1e-9);
  }

  SlotAccount account;
};

TEST_F(SlotAccounts, SlotsWithoutAnythingWantedWaitAtABarrier) {
  hello(1, 2);
  credit(1, 4);
  account.sample(scheduler, Holding::No, now);
  second(1, 2000, 0);
  EXPECT_NEAR(idle(IdleCause::Barrier), 2.0, 1e-9);
  expect_sum();
}

TEST_F(SlotAccounts, WhatIsLeasedAndNotEvaluatedIsTheNetworks) {
  hello(1, 2);
  credit(1, 4);
  want(1, 50);
  account.sample(scheduler, Holding::No, now);
  second(1, 2000, 1500);
  EXPECT_NEAR(idle(IdleCause::Network), 0.5, 1e-9);
  EXPECT_NEAR(account.since_start().busy, 1.5, 1e-9);
  EXPECT_EQ(idle(IdleCause::Barrier), 0);
  expect_sum();
  second(1, 4000, 3500);  // it did not idle at all
  EXPECT_NEAR(idle(IdleCause::Network), 0.5, 1e-9);
  second(1, 6000, 4200);
  EXPECT_NEAR(idle(IdleCause::Network), 0.5 + 1.3, 1e-9);
  EXPECT_NEAR(account.since_start().busy, 4.2, 1e-9);
  expect_sum();
}

TEST_F(SlotAccounts, EachWorkerHasItsOwnWhateverTheOthersDo) {
  hello(1, 2);
  hello(2, 3);
  account.sample(scheduler, Holding::No, now);
  second(2, 3000, 0, 0);
  EXPECT_NEAR(idle(IdleCause::StartUp), 3.0, 1e-9);
  lose(1);
  second(2, 6000, 0, 0);
  EXPECT_NEAR(idle(IdleCause::StartUp), 6.0, 1e-9);
  expect_sum();
}

TEST_F(SlotAccounts, AReportOfLessTimeOrOfNoneChangesNothing) {
  hello(1, 2);
  account.sample(scheduler, Holding::No, now);
  second(1, 2000, 500);
  second(1, 1000, 900);
  beat(1);
  const WorkerEntry& worker = scheduler.workers().all().at(1);
  EXPECT_EQ(worker.slot_us, 2'000'000);
  EXPECT_EQ(worker.busy_us, 500'000);
}

TEST_F(SlotAccounts, AWorkerThatAsksForLessThanItsSlotsHasNoCredit) {
  hello(1, 4);
  credit(1, 1);
  want(1, 50);
  account.sample(scheduler, Holding::No, now);
  second(1, 4000, 1000, 1);
  EXPECT_NEAR(idle(IdleCause::Credit), 3.0, 1e-9);
  expect_sum();
}

TEST_F(SlotAccounts, AWorkerThatHasNotAskedStartsUp) {
  hello(1, 2);
  want(1, 50);
  account.sample(scheduler, Holding::No, now);
  second(1, 2000, 0, 0);
  EXPECT_NEAR(idle(IdleCause::StartUp), 2.0, 1e-9);
  expect_sum();
}

TEST_F(SlotAccounts, NothingIsLeasedWhileAStoreCannotWriteOrPeopleSaySo) {
  hello(1, 2);
  credit(1, 4);
  scheduler.hold(true);
  want(1, 50);
  account.sample(scheduler, Holding::Commit, now);
  second(1, 2000, 0, 4, Holding::Commit);
  EXPECT_NEAR(idle(IdleCause::Commit), 2.0, 1e-9);
  second(1, 4000, 0, 4, Holding::Other);
  EXPECT_NEAR(idle(IdleCause::Held), 2.0, 1e-9);
  expect_sum();
}

TEST_F(SlotAccounts, WhatIsHeldForAStoreOrByPeopleIsNoBarrier) {
  hello(1, 2);
  credit(1, 4);
  scheduler.hold_design(0, 0, true);
  want(1, 50);
  account.sample(scheduler, Holding::No, now);
  second(1, 2000, 0);
  EXPECT_NEAR(idle(IdleCause::Commit), 2.0, 1e-9);
  scheduler.hold_design(0, 0, false);
  scheduler.hold_design(0, 1, true);
  second(1, 4000, 0);
  EXPECT_NEAR(idle(IdleCause::Held), 2.0, 1e-9);
  EXPECT_EQ(idle(IdleCause::Barrier), 0);
  expect_sum();
}

TEST_F(SlotAccounts, APausedDesignThatWantsNothingHoldsNoOtherUp) {
  hello(1, 2);
  credit(1, 4);
  scheduler.hold_design(0, 7, true);
  account.sample(scheduler, Holding::No, now);
  second(1, 2000, 0);
  EXPECT_NEAR(idle(IdleCause::Barrier), 2.0, 1e-9);
}

TEST_F(SlotAccounts, LookAheadThatNoWorkerTookIsNoReasonToIdle) {
  hello(1, 2);
  credit(1, 4);
  scheduler.hold_design(0, 1, true);
  scheduler.add({{{.machine = "m"}, {{1}, Purpose::Race, 1}, 0, true}});
  account.sample(scheduler, Holding::No, now);
  second(1, 2000, 0);
  EXPECT_EQ(scheduler.leases().queued(), 1U);
  EXPECT_NEAR(idle(IdleCause::Barrier), 2.0, 1e-9);
}

TEST_F(SlotAccounts, AClockThatIsSetBackTakesNoTimeAway) {
  hello(1, 2);
  credit(1, 4);
  account.sample(scheduler, Holding::No, now);
  second(1, 2000, 0);
  now -= seconds(30);
  second(1, 4000, 0);
  EXPECT_NEAR(account.since_start().slots, 4.0, 1e-9);
  for (const double time : account.since_start().idle)
    EXPECT_GE(time, 0);
  expect_sum();
}

TEST_F(SlotAccounts, CausesNeverMakeMoreThanTheWorkerIdled) {
  hello(1, 2);
  credit(1, 4);
  account.sample(scheduler, Holding::No, now);
  // It evaluated most of the time, between the samples.
  second(1, 2000, 1800);
  EXPECT_NEAR(idle(IdleCause::Barrier), 0.2, 1e-9);
  EXPECT_NEAR(idle(IdleCause::Network), 0.0, 1e-9);
  expect_sum();
}

TEST_F(SlotAccounts, AWorkerThatLiesMakesNoMoreTimeThanThereWas) {
  hello(1, 2);
  credit(1, 4);
  account.sample(scheduler, Holding::No, now);
  second(1, 1'000'000'000, 0);
  EXPECT_LE(account.since_start().slots, 2 * 6.0 + 1e-9);
  expect_sum();
}

TEST_F(SlotAccounts, TheLastMinuteForgetsWhatWasBefore) {
  hello(1, 1);
  credit(1, 2);
  account.sample(scheduler, Holding::No, now);
  std::int64_t slot_ms = 0;
  for (int i = 0; i < 30; ++i)
    second(1, slot_ms += 1000, 0);
  const std::int64_t idle_ms = slot_ms;
  for (int i = 0; i < 120; ++i) {
    slot_ms += 1000;
    second(1, slot_ms, slot_ms - idle_ms);
  }
  const SlotTimes minute = account.last_minute();
  EXPECT_NEAR(minute.slots, 60, 1.5);
  EXPECT_NEAR(minute.busy, minute.slots, 1e-6);
  EXPECT_NEAR(minute.idle_total(), 0, 1e-6);
  EXPECT_NEAR(account.since_start().idle_total(), 30, 1e-6);
  EXPECT_NEAR(account.rate_of(1).busy, 1, 1e-6);
  const std::int64_t busy_ms = slot_ms - idle_ms;
  for (int i = 1; i <= 10; ++i)
    second(1, slot_ms + 1000 * i, busy_ms + 250 * i);
  EXPECT_NEAR(account.rate_of(1).busy, 0.25, 1e-6);
}

}  // namespace
}  // namespace swarmsmith
