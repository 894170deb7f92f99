#include "coordinator/design/known_scores.h"

#include <gtest/gtest.h>

namespace swarmsmith {
namespace {

StoredScore score(Purpose purpose, std::int64_t pair, double value) {
  return {
      .key = {candidate_id({2}, 1), purpose, pair}, .measured = {.score = value}, .iteration = 3};
}

StoredDesign stored(const StoredScore& race, const StoredScore& test) {
  StoredDesign design;
  design.race_scores.emplace(packed_key(race.key), race);
  design.test_scores.emplace(packed_key(test.key), test);
  return design;
}

TEST(KnownScores, AScoreOfTheRaceIsHandedOverUntilItIsKeptAgain) {
  const StoredScore race = score(Purpose::Race, 4, 0.5);
  KnownScores scores(stored(race, score(Purpose::Test, 4, 0.7)));
  ASSERT_NE(scores.stored(race.key), nullptr);
  EXPECT_EQ(scores.take(race.key)->iteration, 3);
  EXPECT_FALSE(scores.contains(race.key));
  EXPECT_FALSE(scores.take(race.key));
  scores.keep(race);
  EXPECT_TRUE(scores.contains(race.key));
  EXPECT_EQ(scores.stored(race.key), nullptr) << "it was asked for";
  EXPECT_EQ(scores.take(race.key)->iteration, 0) << "no iteration uses it";
}

TEST(KnownScores, AScoreOfATestStays) {
  const StoredScore test = score(Purpose::Test, 4, 0.7);
  KnownScores scores(stored(score(Purpose::Race, 4, 0.5), test));
  EXPECT_EQ(scores.take(test.key)->measured.score, 0.7);
  EXPECT_EQ(scores.take(test.key)->measured.score, 0.7);
  EXPECT_TRUE(scores.unasked().test_scores.empty());
  EXPECT_EQ(scores.discard_race().size(), 1U);
  EXPECT_TRUE(scores.unasked().race_scores.empty());
}

TEST(KnownScores, ATestUnderAFurtherProfileIsATest) {
  const StoredScore transfer = score(Purpose::Transfer, 14, 0.7);
  KnownScores scores(stored(score(Purpose::Race, 4, 0.5), transfer));
  EXPECT_EQ(scores.take(transfer.key)->measured.score, 0.7);
  EXPECT_EQ(scores.take(transfer.key)->measured.score, 0.7);
  EXPECT_TRUE(scores.unasked().test_scores.empty());
}

}  // namespace
}  // namespace swarmsmith
