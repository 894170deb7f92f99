#include "analysis/records/records.h"

#include <algorithm>

#include "tests/storage/fixture.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

struct RecordsTest : FilledStore {};

TEST_F(RecordsTest, DesignsHaveTheirBestMachine) {
  const auto all = value_of(designs(*reader, {}));
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all.front().state, "finished");
  EXPECT_EQ(all.front().mission, campaign.designs.front().mission);
  ASSERT_TRUE(all.front().best);
  EXPECT_FALSE(all.front().machine.empty());
  const auto second = value_of(designs(*reader, {.design = DesignId{2}}));
  ASSERT_EQ(second.size(), 1U);
  EXPECT_EQ(second.front().design, DesignId{2});
  EXPECT_TRUE(designs(*reader, {.mission = "it's not there"})->empty());
}

TEST_F(RecordsTest, ScoresAreTheWinnersTests) {
  const auto scores = value_of(design_scores(*reader, {.design = DesignId{1}}));
  EXPECT_EQ(scores.size(), 4U);
  for (const DesignScore& score : scores) {
    EXPECT_EQ(score.purpose, "test");
    EXPECT_EQ(score.candidate, *designs(*reader, {.design = DesignId{1}})->front().best);
  }
}

TEST_F(RecordsTest, ARaceHasACellForEachLivingCandidateAndStep) {
  const auto steps = race_steps(*reader, DesignId{1}, 2);
  const auto cells = race_cells(*reader, DesignId{1}, 2);
  ASSERT_TRUE(steps);
  ASSERT_TRUE(cells);
  ASSERT_FALSE(steps->empty());
  for (const StepRecord& step : *steps)
    EXPECT_EQ(std::ranges::count(*cells, step.step, &RaceCell::step), step.alive_before);
}

TEST_F(RecordsTest, CandidatesAreInTheOrderOfSampling) {
  const auto all = value_of(candidates(*reader, DesignId{2}));
  ASSERT_EQ(all.size(), 3U * 8);
  EXPECT_EQ(all.front().candidate, CandidateId{1000001});
  EXPECT_EQ(all.front().iteration, 1);
  EXPECT_EQ(all.back().iteration, 3);
  EXPECT_TRUE(std::ranges::all_of(all, [](const auto& row) { return row.runs > 0 && row.mean; }));
}

TEST_F(RecordsTest, IterationsSayTheirBudget) {
  const auto all = value_of(iterations(*reader, DesignId{1}));
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all.back().iteration, 3);
  EXPECT_EQ(all.back().planned, 3);
  EXPECT_EQ(all.back().budget, 1000);
  EXPECT_EQ(all.back().configurations, 8);
  EXPECT_FALSE(all.back().postselection);
}

TEST_F(RecordsTest, ElitesEndEachIteration) {
  const auto all = value_of(elites(*reader, {.design = DesignId{2}}));
  ASSERT_FALSE(all.empty());
  EXPECT_EQ(all.back().iteration, 3);
  EXPECT_GT(all.back().experiments_used, all.front().experiments_used);
}

TEST_F(RecordsTest, ParametersAreNumbersOrTexts) {
  const CandidateId best = *designs(*reader, {})->front().best;
  const auto values = value_of(parameters(*reader, DesignId{1}, {best}));
  ASSERT_FALSE(values.empty());
  EXPECT_TRUE(std::ranges::all_of(values, [&](const auto& p) { return p.candidate == best; }));
  EXPECT_TRUE(std::ranges::any_of(values, &ParameterRecord::is_number));
}

TEST_F(RecordsTest, CampaignsHaveTheirFile) {
  const auto all = value_of(campaigns(*reader));
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all.front().campaign, 1);
  EXPECT_EQ(all.front().name, campaign.campaign.name);
  EXPECT_EQ(all.front().file, campaign.campaign.file);
}

TEST_F(RecordsTest, CsvQuotesWhatItMust) {
  const auto text = value_of(csv_of_rows(
      *reader, "SELECT 1 AS \"a,b\", 'x\"y' AS c, NULL AS d, 0.1 AS e, 'line\nfeed' AS f"));
  EXPECT_EQ(text, "\"a,b\",c,d,e,f\n1,\"x\"\"y\",,0.1,\"line\nfeed\"\n");
  EXPECT_FALSE(csv_of_rows(*reader, "SELECT * FROM v_nothing"));
}

}  // namespace
}  // namespace swarmsmith
