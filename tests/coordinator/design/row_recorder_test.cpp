#include "coordinator/design/row_recorder.h"

#include <cmath>
#include <iterator>
#include <string>

#include "coordinator/design/candidate_totals.h"
#include "storage/rows.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

RaceStep step(std::uint64_t digest) {
  return {.iteration = 1, .task = 1, .pair = 1, .best = 1, .experiments_used = 1, .digest = digest};
}

std::vector<Row> rows_of(RowRecorder& recorder) {
  std::vector<Row> rows;
  recorder.move_rows_to(rows);
  return rows;
}

TEST(RowRecorder, GivesRowsFromTheLastStoredStepOn) {
  RowRecorder recorder({1}, "profile", {11});
  recorder.record_candidate({.id = 1, .iteration = 1}, {});
  ASSERT_TRUE(recorder.record_step(step(11)));
  EXPECT_TRUE(rows_of(recorder).empty());
  EXPECT_FALSE(recorder.is_replaying());
  ASSERT_TRUE(recorder.record_step(step(12)));
  const std::vector<Row> rows = rows_of(recorder);
  ASSERT_EQ(rows.size(), 2U) << "the step, and the design as it stands";
  EXPECT_EQ(std::get<RaceStepRow>(rows.front()).step, 2);
}

TEST(RowRecorder, HasNoNumberForMoreThanAMillionCandidates) {
  EXPECT_EQ(candidate_id({2}, kCandidatesPerDesign).value, 2 * kCandidatesPerDesign);
  EXPECT_DEATH(candidate_id({2}, kCandidatesPerDesign + 1), "within its design");
  EXPECT_DEATH(candidate_id({2}, 0), "within its design");
  EXPECT_DEATH(candidate_id({0}, 1), "within its design");
}

TEST(RowRecorder, FindsAStepThatTheStoreHasOtherwise) {
  RowRecorder recorder({1}, "profile", {11});
  const Error recorded = why_not(recorder.record_step(step(12)));
  EXPECT_EQ(recorded.kind, ErrorKind::Corrupt);
  EXPECT_THAT(to_string(recorded), HasSubstr("d1, step 1"));
}

/// Such as two configurations that a repair program mixed up. No reader opens a store with more.
TEST(RowRecorder, CutsAReasonThatIsTooLongForAStore) {
  RowRecorder recorder({1}, "profile", {});
  recorder.set_reason(std::string(kLongestReason + 1, 'x'));
  EXPECT_EQ(std::ssize(recorder.design().reason), kLongestReason);
}

TEST(RowRecorder, GivesEachPairOfAPurposeOnce) {
  RowRecorder recorder({1}, "profile", {});
  for (const std::int64_t pair : {1, 2, 1, 2, 3})
    recorder.record_pair(Purpose::Race, {.configuration = 1, .pair = pair});
  recorder.record_pair(Purpose::Test, {.configuration = 1, .pair = 1});
  EXPECT_EQ(rows_of(recorder).size(), 4U);
}

TEST(RowRecorder, SumsWhatATargetEvaluatorSaidLast) {
  RowRecorder recorder({1}, "command", {});
  recorder.record_candidate({.id = 1, .iteration = 1}, {});
  recorder.record_judged(1, 1, 2);
  recorder.record_judged(1, 2, 4);
  recorder.record_judged(1, 1, 3);
  const auto totals = std::get<CandidateTotalsRow>(rows_of(recorder).back());
  EXPECT_EQ(totals.runs, 2);
  EXPECT_EQ(totals.score_sum, 7);
  EXPECT_EQ(totals.score_squares, 25);
}

TEST(CandidateTotals, OfHugeScoresAreFinite) {
  CandidateTotals totals({1});
  totals.add_up_to(1);
  totals.add_run(1, -1e300);
  const CandidateTotalsRow row = totals.add_run(1, -1e300);
  EXPECT_EQ(row.score_sum, -2e300);
  EXPECT_TRUE(std::isfinite(row.score_squares));
}

}  // namespace
}  // namespace swarmsmith
