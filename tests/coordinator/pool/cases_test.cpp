#include "coordinator/pool/cases.h"

#include <gtest/gtest.h>

#include "coordinator/pool/task_key.h"

namespace swarmsmith {
namespace {

Task task(std::int64_t candidate) {
  return {{}, {{candidate}, Purpose::Race, 1}};
}
PackedKey key(std::int64_t candidate) {
  return key_of(task(candidate));
}

TEST(Cases, ComeOneAtATimeAndAuditsLast) {
  Cases cases;
  cases.open(task(1), Said{}, true);
  cases.open(task(2), Said{}, false);
  EXPECT_EQ(cases.next()->key.candidate.value, 2);
  EXPECT_FALSE(cases.next()) << "the referee is at work";
  EXPECT_TRUE(cases.close(key(2)));
  EXPECT_EQ(cases.next()->key.candidate.value, 1);
  EXPECT_TRUE(cases.close(key(1)));
  EXPECT_TRUE(cases.empty());
}

TEST(Cases, GatherWhatIsSaidOfOneEvaluation) {
  Cases cases;
  cases.open(task(1), Said{.worker = 1}, true);
  cases.open(task(2), Said{.worker = 2}, true);
  cases.open(task(2), Said{.worker = 3}, false);
  EXPECT_EQ(cases.size(), 2U);
  EXPECT_EQ(cases.next()->key.candidate.value, 2) << "it is urgent now";
  EXPECT_EQ(cases.close(key(2))->said.size(), 2U);
}

TEST(Cases, ForgetACampaignWhileTheRefereeIsAtWork) {
  Cases cases;
  cases.open(task(1), Said{.worker = 4}, false);
  ASSERT_TRUE(cases.next());
  const std::vector<Case> gone = cases.forget(0);
  ASSERT_EQ(gone.size(), 1U);
  EXPECT_EQ(gone[0].said.at(0).worker, 4);
  EXPECT_FALSE(cases.close(key(1)));
  cases.open(task(2), std::nullopt, false);
  EXPECT_EQ(cases.without_worker(), 1U);
  EXPECT_TRUE(cases.next()) << "the next one may begin";
}

}  // namespace
}  // namespace swarmsmith
