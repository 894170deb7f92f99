#include "analysis/records/records.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

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

/// Its second answer to a call is the opposite of what the run printed; the first one is out of
/// date.
TEST(RaceCells, HaveTheScoresAndRanksOfATargetEvaluator) {
  const TemporaryFolder folder;
  SyntheticCampaign campaign = synthetic_campaign({.designs = 1, .iterations = 1});
  campaign.campaign.file += "\nevaluator = \"./e\"\n";
  std::vector<Row> calls;
  std::map<std::int64_t, PairRow> pairs;
  std::int64_t number = 0;
  for (const std::vector<Row>& batch : campaign.batches) {
    for (const Row& row : batch) {
      if (const auto* pair = std::get_if<PairRow>(&row); pair && pair->purpose == Purpose::Race)
        pairs[pair->number] = *pair;
    }
  }
  for (const std::vector<Row>& batch : campaign.batches) {
    for (const Row& row : batch) {
      const auto* run = std::get_if<EvaluationRow>(&row);
      if (run == nullptr || run->key.purpose != Purpose::Race) continue;
      for (const double factor : {7.0, -1.0}) {
        PairRow pair = pairs.at(run->key.pair);
        pair.purpose = Purpose::Evaluator;
        pair.number = ++number;
        calls.emplace_back(pair);
        EvaluationRow call{.key = {run->key.candidate, Purpose::Evaluator, number},
                           .measured = {.score = factor * run->measured.score},
                           .source = "command"};
        calls.emplace_back(std::move(call));
      }
    }
  }
  fill_store(folder / "runs.db", campaign);
  campaign.batches.push_back(std::move(calls));
  fill_store(folder / "judged.db", campaign);
  const auto runs = value_of(race_cells(*open_reader(folder / "runs.db"), DesignId{1}, 1));
  const auto judged = value_of(race_cells(*open_reader(folder / "judged.db"), DesignId{1}, 1));
  ASSERT_EQ(judged.size(), runs.size());
  ASSERT_GT(runs.size(), 10U);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const auto peers = std::ranges::count_if(
        runs, [&](const RaceCell& cell) { return cell.step == runs[i].step && cell.rank; });
    ASSERT_EQ(judged[i].score.has_value(), runs[i].score.has_value());
    if (!runs[i].score) continue;
    EXPECT_EQ(*judged[i].score, -*runs[i].score);
    EXPECT_EQ(*judged[i].rank, static_cast<double>(peers) + 1 - *runs[i].rank);
  }
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
