#include "coordinator/done_table.h"

#include <gtest/gtest.h>

namespace swarmsmith {
namespace {

constexpr auto kOk = EvaluationStatus::Ok;
constexpr auto kRejected = EvaluationStatus::Rejected;

TEST(DoneTable, KeepsTheFirstOutcome) {
  DoneTable table;
  EXPECT_EQ(table.find(5), nullptr);
  table.insert(5, kOk, 1.5, 7);
  table.insert(5, kOk, 2.5, 8);
  ASSERT_NE(table.find(5), nullptr);
  EXPECT_TRUE(DoneTable::same(*table.find(5), kOk, 1.5, 7));
  EXPECT_EQ(table.size(), 1U);
}

TEST(DoneTable, ComparesEveryBit) {
  DoneTable table;
  const DoneEntry& entry = *table.insert(5, kOk, 0.0, 7);
  EXPECT_FALSE(DoneTable::same(entry, kOk, -0.0, 7));
  EXPECT_FALSE(DoneTable::same(entry, kOk, 0.0, 8));
  EXPECT_FALSE(DoneTable::same(entry, kRejected, 0.0, 7));
  const DoneEntry& rejected = *table.insert(6, kRejected, 0.0, 0);
  EXPECT_TRUE(DoneTable::same(rejected, kRejected, 99, 99));
  EXPECT_FALSE(DoneTable::same(rejected, kOk, 0, 0));
}

TEST(DoneTable, FindsAMillion) {
  DoneTable table;
  for (PackedKey key = 1; key <= 1'000'000; ++key) {
    table.insert(key << 3U, kOk, static_cast<double>(key), key);
  }
  EXPECT_EQ(table.size(), 1'000'000U);
  for (PackedKey key = 1; key <= 1'000'000; key += 997) {
    ASSERT_NE(table.find(key << 3U), nullptr);
    EXPECT_EQ(table.find(key << 3U)->state_digest, key);
    EXPECT_EQ(table.find((key << 3U) + 1), nullptr);
  }
}

}  // namespace
}  // namespace swarmsmith
