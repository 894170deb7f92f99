#include "coordinator/pool/done_table.h"

#include <gtest/gtest.h>

namespace swarmsmith {
namespace {

constexpr auto kOk = EvaluationStatus::Ok;
constexpr auto kRejected = EvaluationStatus::Rejected;

TEST(DoneTable, KeepsTheFirstOutcome) {
  DoneTable table;
  EXPECT_EQ(table.find(5), nullptr);
  table.insert(5, kOk, {1.5, 7});
  table.insert(5, kOk, {2.5, 8});
  ASSERT_NE(table.find(5), nullptr);
  EXPECT_TRUE(DoneTable::same(*table.find(5), kOk, {1.5, 7}));
  EXPECT_EQ(table.size(), 1U);
}

TEST(DoneTable, ComparesEveryBit) {
  DoneTable table;
  const DoneEntry& entry = *table.insert(5, kOk, {0.0, 7});
  EXPECT_FALSE(DoneTable::same(entry, kOk, {-0.0, 7}));
  EXPECT_FALSE(DoneTable::same(entry, kOk, {0.0, 8}));
  EXPECT_FALSE(DoneTable::same(entry, kRejected, {0.0, 7}));
  const DoneEntry& rejected = *table.insert(6, kRejected, {0.0, 0});
  EXPECT_TRUE(DoneTable::same(rejected, kRejected, {99, 99}));
  EXPECT_FALSE(DoneTable::same(rejected, kOk, {0, 0}));
}

TEST(DoneTable, ForgetsADesignThatIsOver) {
  const auto key = [](std::int64_t design, std::uint32_t campaign) {
    return pack({.candidate = candidate_id({design}, 1), .pair = 1}, campaign);
  };
  DoneTable table;
  table.insert(key(1, 0), kOk, {1.5, 7});
  table.insert(key(2, 0), kOk, {2.5, 7});
  table.insert(key(1, 1), kOk, {3.5, 7});
  table.close(0, {1});
  EXPECT_EQ(table.find(key(1, 0)), nullptr);
  EXPECT_EQ(table.insert(key(1, 0), kOk, {1.5, 7}), nullptr);
  EXPECT_TRUE(table.is_closed(key(1, 0)));
  EXPECT_FALSE(table.is_closed(key(2, 0)));
  EXPECT_FALSE(table.is_closed(key(1, 1)));
  EXPECT_FALSE(table.is_closed(key(9, 9)));
  EXPECT_NE(table.find(key(2, 0)), nullptr);
  EXPECT_NE(table.find(key(1, 1)), nullptr);
  EXPECT_EQ(table.size(), 2U);
}

TEST(DoneTable, ForgetsCandidatesThatAreOutOfTheirRace) {
  const auto key = [](std::int64_t number, std::int64_t pair) {
    return pack({.candidate = candidate_id({2}, number), .pair = pair});
  };
  DoneTable table;
  for (std::int64_t number = 1; number <= 100; ++number) {
    for (std::int64_t pair = 1; pair <= 50; ++pair)
      table.insert(key(number, pair), kOk, {static_cast<double>(pair), 7});
  }
  table.close_candidates(0, {.design = {2},
                             .before = candidate_id({2}, 90),
                             .kept = {candidate_id({2}, 40), candidate_id({2}, 7)}});
  EXPECT_EQ(table.size(), 50U * (2 + 11));
  EXPECT_TRUE(table.is_closed(key(1, 1)));
  EXPECT_TRUE(table.is_closed(key(89, 77))) << "whatever comes of it";
  EXPECT_EQ(table.find(key(89, 1)), nullptr);
  EXPECT_NE(table.insert(key(89, 1), kOk, {1, 7}), nullptr) << "a test, asked for once more";
  EXPECT_NE(table.find(key(89, 1)), nullptr);
  for (const std::int64_t number : {7, 40, 90, 100}) {
    EXPECT_FALSE(table.is_closed(key(number, 1)));
    ASSERT_NE(table.find(key(number, 33)), nullptr);
    EXPECT_TRUE(DoneTable::same(*table.find(key(number, 33)), kOk, {33, 7}));
  }
  EXPECT_NE(table.insert(key(101, 1), kOk, {1, 7}), nullptr);
  EXPECT_FALSE(table.is_closed(pack({.candidate = candidate_id({1}, 1), .pair = 1})));
  table.close_candidates(0, {.design = {2}, .before = candidate_id({2}, 102)});
  EXPECT_EQ(table.size(), 0U);
}

TEST(DoneTable, FindsAMillion) {
  DoneTable table;
  for (PackedKey key = 1; key <= 1'000'000; ++key) {
    table.insert(key << 3U, kOk, {static_cast<double>(key), key});
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
