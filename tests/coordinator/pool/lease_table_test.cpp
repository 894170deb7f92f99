#include "coordinator/pool/lease_table.h"

#include <gtest/gtest.h>
#include <map>
#include <set>
#include <vector>

#include "base/rng.h"
#include "coordinator/pool/worker_loads.h"

namespace swarmsmith {
namespace {

Task task(std::int64_t candidate) {
  return {{}, {{candidate}, Purpose::Race, 1}};
}

/// Room and idle slots of all workers are sums that each change keeps up to date.
TEST(WorkerLoads, SumsAreThoseOfTheWorkersAfterEachChange) {
  constexpr std::int64_t kWorkers = 4;
  WorkerLoads loads;
  Rng rng(5);
  std::map<WorkerNumber, std::vector<WorkerLoads::Place>> places;
  for (int step = 0; step < 2000; ++step) {
    const WorkerNumber worker = rng.uniform_int(1, kWorkers);
    const auto key = static_cast<PackedKey>(rng.uniform_int(1, 8));
    std::vector<WorkerLoads::Place>& held = places[worker];
    switch (rng.uniform_int(0, 4)) {
      case 0: {
        const auto slots = static_cast<std::size_t>(rng.uniform_int(0, 4));
        const auto credit = static_cast<std::size_t>(rng.uniform_int(0, 8));
        loads.set_capacity(worker, slots, slots == 0 ? 0 : credit);  // it left with its credit
        break;
      }
      case 1:
        held.push_back(loads.lease(worker, key, false));
        break;
      case 2:
        if (held.empty()) break;
        loads.end(worker, held.back(), false);
        held.pop_back();
        break;
      case 3:
        loads.linger(worker, key, TimePoint(Duration(step)));
        break;
      default:
        loads.settle_older(worker, TimePoint(Duration(step - 20)));
    }
    const bool lingers = loads.of(worker).lingering.contains(key);
    EXPECT_EQ(loads.renew_lingering(worker, key, TimePoint(Duration(step))), lingers);
    std::size_t room = 0;
    std::size_t idle = 0;
    std::set<WorkerNumber> with_room;
    std::set<WorkerNumber> with_idle;
    for (WorkerNumber each = 1; each <= kWorkers; ++each) {
      room += loads.of(each).room();
      idle += loads.of(each).idle();
      if (loads.of(each).room() > 0) with_room.insert(each);
      if (loads.of(each).idle() > 0) with_idle.insert(each);
    }
    ASSERT_EQ(loads.room(), room);
    ASSERT_EQ(loads.idle(), idle);
    ASSERT_EQ(loads.with_room(), with_room);
    ASSERT_EQ(loads.with_idle(), with_idle);
  }
}

class Leases : public ::testing::Test {
 protected:
  /// Leases the next task to a worker; its candidate, or 0.
  std::int64_t lease(WorkerNumber worker, bool skip_avoided = false) {
    TaskRecord* record = table.next(worker, skip_avoided);
    if (record == nullptr) record = table.next_ahead(worker, skip_avoided);
    if (record == nullptr) return 0;
    table.grant(*record, worker, {});
    return record->task.key.candidate.value;
  }
  TaskRecord& record(std::int64_t candidate) { return *table.find(pack(task(candidate).key)); }

  LeaseTable table;
};

TEST_F(Leases, GoOutInOrderAndComeBackToTheFront) {
  for (std::int64_t i = 1; i <= 4; ++i)
    EXPECT_TRUE(table.add(task(i)));
  EXPECT_EQ(lease(7), 1);
  EXPECT_EQ(lease(7), 2);
  table.requeue(record(1), 7);
  EXPECT_EQ(lease(8), 1);
  EXPECT_EQ(record(1).lease->attempt, 2);
  EXPECT_EQ(lease(8), 3);
  EXPECT_EQ(table.leased(), 3U);
  EXPECT_EQ(table.queued(), 1U);
}

TEST_F(Leases, TakeATaskOnce) {
  EXPECT_TRUE(table.add(task(1)));
  EXPECT_FALSE(table.add(task(1)));
  EXPECT_EQ(table.size(), 1U);
}

TEST_F(Leases, PutLookAheadLast) {
  Task ahead = task(1);
  ahead.ahead = true;
  table.add(ahead);
  table.add(task(2));
  EXPECT_EQ(lease(7), 2);
  EXPECT_EQ(lease(7), 1);
}

TEST_F(Leases, PromoteLookAheadThatIsWanted) {
  Task ahead = task(1);
  ahead.ahead = true;
  table.add(ahead);
  table.add(task(2));
  table.promote(record(1));
  table.add(task(3));
  EXPECT_EQ(lease(7), 2);
  EXPECT_EQ(lease(7), 1);
  EXPECT_EQ(lease(7), 3);
}

TEST_F(Leases, RemoveAllOfACampaign) {
  Task other = task(1);
  other.campaign = 1;
  table.add(other);
  table.add(task(1));
  table.add(task(2));
  EXPECT_EQ(lease(7), 1);
  EXPECT_EQ(lease(7), 1);  // of the other campaign, which had nothing yet
  table.remove_all(1);
  EXPECT_EQ(table.size(), 2U);
  EXPECT_EQ(table.leased(), 1U);
  EXPECT_EQ(lease(7), 2);
}

TEST_F(Leases, PassOverWhatShouldBeTriedElsewhere) {
  table.add(task(1));
  table.add(task(2));
  lease(7);
  record(1).avoid = 7;
  table.requeue(record(1), 7);
  EXPECT_EQ(lease(7, true), 2);
  EXPECT_EQ(lease(7, true), 0);
  EXPECT_EQ(lease(8, true), 1);
}

TEST_F(Leases, KeepWhatRunsAloneApart) {
  table.add(task(1));
  lease(7);
  record(1).alone = true;
  table.requeue(record(1), 7);
  EXPECT_TRUE(table.has_alone());
  EXPECT_EQ(table.wanted_of({0, 0}), 1U);
  EXPECT_EQ(table.wanted_of({0, 2}), 0U);
  EXPECT_EQ(lease(7), 0);
  table.grant(*table.next_alone(), 8, {});
  EXPECT_FALSE(table.has_alone());
  EXPECT_TRUE(record(1).lease->alone);
}

TEST_F(Leases, AreListedByWorkerOldestFirst) {
  for (std::int64_t i = 1; i <= 3; ++i)
    table.add(task(i));
  lease(7);
  lease(8);
  lease(7);
  EXPECT_EQ(table.leases_of(7), (std::list<PackedKey>{pack(task(1).key), pack(task(3).key)}));
  table.remove(pack(task(1).key));
  EXPECT_EQ(table.leases_of(7).size(), 1U);
  EXPECT_TRUE(table.leases_of(9).empty());
}

TEST_F(Leases, ForgetAQueuedTaskThatIsRemoved) {
  table.add(task(1));
  table.add(task(2));
  table.remove(pack(task(1).key));
  EXPECT_EQ(lease(7), 2);
  EXPECT_EQ(lease(7), 0);
}

}  // namespace
}  // namespace swarmsmith
