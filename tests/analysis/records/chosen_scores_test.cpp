#include "analysis/records/chosen_scores.h"

#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

DesignScore score_of(std::int64_t design, const std::string& purpose, double score,
                     const std::string& source = "rvr") {
  return {.design = DesignId{design},
          .mission = "aggregation",
          .method = "watermelon",
          .source = source,
          .purpose = purpose,
          .score = score};
}

std::vector<double> numbers(const ChosenScores& taken) {
  std::vector<double> numbers;
  for (const ScoreValue& value : values_of(taken))
    numbers.push_back(value.score.score);
  return numbers;
}

DesignScore run_of(std::int64_t design, const std::string& source, std::int64_t seed) {
  DesignScore run = score_of(design, "score", 1, source);
  run.instance = 1;
  run.seed = seed;
  return run;
}

TEST(ChosenScores, SaysWhereSourcesHaveOtherSeeds) {
  std::vector<DesignScore> scores = {run_of(1, "rvr", 1), run_of(1, "rvr", 2),
                                     run_of(1, "argos3", 2), run_of(1, "argos3", 1)};
  EXPECT_FALSE(seeds_differ(scores, "rvr", "argos3"));  // in whatever order
  scores.push_back(run_of(2, "rvr", 1));
  scores.push_back(run_of(2, "argos3", 7));
  scores.push_back(run_of(3, "rvr", 1));  // in one source alone
  scores.push_back(run_of(3, "real", 9));
  EXPECT_EQ(
      *seeds_differ(scores, "rvr", "argos3"),
      "the seeds of rvr and argos3 differ in 1 of 2 designs, so part of the difference may come "
      "from the seeds");
  EXPECT_FALSE(seeds_differ(scores, "rvr", "real"));  // robots have no seeds
}

TEST(ChosenScores, LaterScoresChangeNothingWhereThereAreTests) {
  const std::vector<DesignScore> scores = {score_of(1, "test", 1), score_of(1, "test", 3),
                                           score_of(1, "score", 90), score_of(2, "test", 7)};
  EXPECT_THAT(numbers(chosen(scores, {})), ElementsAre(2, 7));
  EXPECT_THAT(numbers(chosen(scores, {.purpose = "score"})), ElementsAre(90));
  EXPECT_THAT(numbers(chosen(scores, {.purpose = "all", .unit = ScoreUnit::Run})),
              ElementsAre(1, 3, 90, 7));
}

TEST(ChosenScores, TestsUnderAFurtherProfileAreTests) {
  DesignScore transfer = score_of(1, "score", 5, "pseudo-reality");
  transfer.is_transfer = true;
  const std::vector<DesignScore> scores = {score_of(1, "test", 1), score_of(2, "test", 2), transfer,
                                           score_of(1, "score", 9, "pseudo-reality")};
  const ChosenScores taken = chosen(scores, {});
  EXPECT_THAT(numbers(taken), ElementsAre(1, 2, 5));
  EXPECT_EQ(taken.said, "a value is a design: the mean of its tests");
  EXPECT_THAT(numbers(chosen(scores, {.purpose = "score"})), ElementsAre(5, 9)) << "of the view";
}

TEST(ChosenScores, ASourceWithoutTestsTakesWhatWasScoredLater) {
  const ChosenScores taken = chosen({score_of(1, "test", 1), score_of(2, "test", 2),
                                     score_of(1, "score", 5, "real"), score_of(1, "score", 9)},
                                    {});
  EXPECT_THAT(numbers(taken), ElementsAre(1, 2, 5));
  EXPECT_EQ(taken.said, "a value is a design: the mean of its tests or later runs");
}

TEST(ChosenScores, OneDesignAGroupIsShownByItsRuns) {
  const ChosenScores taken = chosen({score_of(1, "test", 1), score_of(1, "test", 3)}, {});
  EXPECT_EQ(taken.unit, ScoreUnit::Run);
  EXPECT_THAT(numbers(taken), ElementsAre(1, 3));
  EXPECT_THAT(taken.said, HasSubstr("a value is a run"));
}

TEST(ChosenScores, ADesignOfSeveralPurposesSaysSo) {
  const ChosenScores taken =
      chosen({score_of(1, "test", 1), score_of(1, "score", 3), score_of(2, "test", 4)},
             {.purpose = "all"});
  const std::vector<ScoreValue> values = values_of(taken);
  ASSERT_EQ(values.size(), 2U);
  EXPECT_EQ(values[0].score.purpose, "all");
  EXPECT_THAT(values[0].runs, ElementsAre(1, 3));
  EXPECT_EQ(values[1].score.purpose, "test");
}

}  // namespace
}  // namespace swarmsmith
