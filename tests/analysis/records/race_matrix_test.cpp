#include "analysis/records/race_matrix.h"

#include <algorithm>

#include "storage/internal/sqlite.h"
#include "tests/storage/fixture.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

struct RaceMatrixTest : FilledStore {
  RaceMatrixTest() : FilledStore(synthetic_campaign({.designs = 1, .iterations = 2})) {}

  void change(const std::string& sql) {
    sqlite::Connection((folder / "s.db").string(), SQLITE_OPEN_READWRITE).execute(sql);
  }

  RaceMatrix matrix() {
    reader = open_reader(folder / "s.db");
    return value_of(race_matrix(*reader, DesignId{1}, 2));
  }
};

TEST_F(RaceMatrixTest, HasTheCellsOfTheViewAndNoOthers) {
  const RaceMatrix race = matrix();
  const auto cells = race_cells(*reader, DesignId{1}, 2);
  ASSERT_GT(cells->size(), 20U);
  std::size_t found = 0;
  for (const RaceMatrix::Row& row : race.rows) {
    for (std::size_t column = 0; column < race.steps.size(); ++column)
      found += row.at(column).has_run ? 1U : 0U;
  }
  EXPECT_EQ(found, cells->size());
  for (const RaceCell& cell : *cells) {
    const auto step = std::ranges::find(race.steps, cell.step, &StepRecord::step);
    const auto row = std::ranges::find(race.rows, cell.candidate, &RaceMatrix::Row::candidate);
    ASSERT_NE(row, race.rows.end());
    const auto same = row->at(static_cast<std::size_t>(step - race.steps.begin()));
    EXPECT_EQ(same.score, cell.score);
    EXPECT_EQ(same.rank, cell.rank);
    EXPECT_TRUE(step->instance && step->seed);
  }
}

TEST_F(RaceMatrixTest, RowsAreElitesByRankThenByHowFarTheyCameThenByMeanRank) {
  const RaceMatrix race = matrix();
  ASSERT_GE(race.rows.size(), 6U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(race.rows[i].elite_after, static_cast<std::int64_t>(i) + 1);
    EXPECT_FALSE(race.rows[i].dropped_after);
  }
  bool any_dropped = false;
  for (std::size_t i = 4; i < race.rows.size(); ++i) {
    const RaceMatrix::Row& before = race.rows[i - 1];
    const RaceMatrix::Row& row = race.rows[i];
    ASSERT_TRUE(row.dropped_after && before.dropped_after);
    any_dropped = any_dropped || !row.came_to_the_end();
    EXPECT_GE(before.came_to_the_end(), row.came_to_the_end());
    EXPECT_GE(*before.dropped_after, *row.dropped_after);
    if (before.dropped_after == row.dropped_after && before.reason == row.reason) {
      EXPECT_LE(before.mean_rank, row.mean_rank);
    }
  }
  EXPECT_TRUE(any_dropped);
}

TEST_F(RaceMatrixTest, WhatTheLastTestDropsComesAfterThoseThatWereOnlyNotKept) {
  const RaceMatrix before = matrix();
  const auto last =
      std::ranges::find_if(before.rows, [](const auto& row) { return row.reason == "not kept"; });
  ASSERT_NE(last, before.rows.end());
  change("UPDATE elimination SET reason = 'test' WHERE candidate = " +
         std::to_string(last->candidate.value));
  const RaceMatrix after = matrix();
  for (const RaceMatrix::Row& row : after.rows) {
    if (row.candidate == last->candidate) break;
    EXPECT_TRUE(row.came_to_the_end());
  }
  const auto moved = std::ranges::find(after.rows, last->candidate, &RaceMatrix::Row::candidate);
  EXPECT_FALSE(moved->came_to_the_end());
  EXPECT_EQ(moved->dropped_after, last->dropped_after);
}

TEST_F(RaceMatrixTest, ARejectedRunHasACellWithoutARank) {
  const CandidateId last = matrix().rows.back().candidate;
  change("UPDATE evaluation SET score = NULL, status = 1 WHERE purpose = 0 AND candidate = " +
         std::to_string(last.value));
  const RaceMatrix race = matrix();
  const auto row = std::ranges::find(race.rows, last, &RaceMatrix::Row::candidate);
  ASSERT_NE(row, race.rows.end());
  EXPECT_TRUE(row->at(0).has_run);
  EXPECT_FALSE(row->at(0).rank);
  EXPECT_EQ(row->mean_rank, std::numeric_limits<double>::infinity());
  EXPECT_EQ(race.steps[0].ranked, static_cast<std::int64_t>(race.rows.size()) - 1);
}

TEST_F(RaceMatrixTest, AnIterationWithoutStepsIsEmpty) {
  const RaceMatrix race = matrix();
  EXPECT_EQ(*last_raced_iteration(*reader, DesignId{1}), 2);
  EXPECT_TRUE(race_matrix(*reader, DesignId{1}, 3)->rows.empty());
  EXPECT_EQ(*last_raced_iteration(*reader, DesignId{9}), 0);
}

}  // namespace
}  // namespace swarmsmith
