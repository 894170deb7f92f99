#include "storage/answer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cmath>

namespace swarmsmith {
namespace {

EvaluationRow evaluation() {
  EvaluationRow row;
  row.key = {.candidate = {7}, .purpose = Purpose::Race, .pair = 3};
  row.iteration = 2;
  row.measured.score = 2.5;
  row.source = "rvr";
  return row;
}

TEST(Answer, LeavesOutWhoMadeAnEvaluationAndHowLongItTook) {
  EvaluationRow elsewhere = evaluation();
  elsewhere.worker = 9;
  elsewhere.attempt = 2;
  elsewhere.measured.wall_us = 1234;
  EXPECT_TRUE(same_answer(evaluation(), elsewhere));
}

TEST(Answer, ChangesWithEveryBitOfAScoreButNotWithTheSignOfZero) {
  EvaluationRow other = evaluation();
  other.measured.score = std::nextafter(2.5, 3.0);
  EXPECT_FALSE(same_answer(evaluation(), other));
  EvaluationRow zero = evaluation();
  zero.measured.score = 0.0;
  EvaluationRow negative = evaluation();
  negative.measured.score = -0.0;
  EXPECT_TRUE(same_answer(zero, negative));
}

TEST(Answer, TellsARejectionFromAScoreOfZero) {
  EvaluationRow zero = evaluation();
  zero.measured.score = 0;
  EvaluationRow rejected = zero;
  rejected.status = EvaluationStatus::Rejected;
  EXPECT_FALSE(same_answer(zero, rejected));
}

TEST(Answer, TellsAbsentNumbersFromZero) {
  RaceStepRow with;
  with.statistic = 0.0;
  EXPECT_FALSE(same_answer(with, RaceStepRow{}));
}

TEST(Answer, TellsKindsOfRowsApart) {
  EXPECT_FALSE(same_answer(EliteRow{}, IterationRow{}));
  EXPECT_TRUE(same_answer(EliteRow{}, EliteRow{}));
}

TEST(Answer, HoldsOnlyWhatTheRaceAndItsTestsWanted) {
  EXPECT_TRUE(in_answer(evaluation()));
  EvaluationRow row = evaluation();
  row.iteration = 0;
  EXPECT_FALSE(in_answer(row));
  row.key.purpose = Purpose::Test;
  EXPECT_TRUE(in_answer(row));
  for (const Purpose purpose : {Purpose::LookAhead, Purpose::Audit, Purpose::Score}) {
    row.key.purpose = purpose;
    EXPECT_FALSE(in_answer(row));
  }
  EXPECT_FALSE(in_answer(WorkerRow{}));
  EXPECT_FALSE(in_answer(EventRow{}));
  EXPECT_FALSE(in_answer(ConflictRow{}));
  EXPECT_FALSE(in_answer(CampaignStateRow{}));
}

TEST(Answer, IsDescribedInOneLineWithKeyAndValues) {
  EXPECT_EQ(describe(evaluation()),
            "evaluation e700003: candidate=c7 purpose=0 pair=3 iteration=2 status=0 score=2.5"
            " state_digest=0 source=rvr");
  EXPECT_THAT(describe(DesignStateRow{.design = {2}, .best = {}, .reason = {}}),
              testing::StartsWith("state of design: design=d2 state=0"));
  CandidateRow longer;
  longer.machine = std::string(500, 'm');
  EXPECT_LT(describe(longer).size(), 300U);
}

TEST(Answer, DescriptionsOfLongTextsDifferWhereverTheTextsDo) {
  CandidateRow one{
      .id = {1}, .parent = {}, .parameters = {}, .machine = std::string(500, 'x'), .modules = {}};
  CandidateRow other = one;
  other.machine.back() = 'y';
  EXPECT_NE(describe(one), describe(other));
}

TEST(Answer, NamesEvaluationsByALetterForTheirPurpose) {
  EvaluationKey key{.candidate = {12}, .purpose = Purpose::Race, .pair = 3};
  EXPECT_EQ(to_string(key), "e1200003");
  key.purpose = Purpose::Test;
  EXPECT_EQ(to_string(key), "e1200003t");
}

}  // namespace
}  // namespace swarmsmith
