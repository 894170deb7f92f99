#include <gmock/gmock.h>

#include <map>

#include "storage/internal/sqlite.h"
#include "tests/storage/fixture.h"

namespace swarmsmith {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Cells = std::vector<std::string>;

/// The public schema. Scripts rely on it: a change here is a new version of the schema, and a line
/// in docs/storage.md.
const std::map<std::string, std::string> kColumns{
    {"v_campaign_status",
     "name state seed designs designs_finished designs_stopped budget used candidates evaluations "
     "workers conflicts created finished campaign"},
    {"v_campaigns", "campaign name seed digest state designs created finished deciding file"},
    {"v_candidates",
     "candidate design number iteration parent n_states n_transitions fsm_config parameters "
     "modules runs mean eliminated_in eliminated_at eliminated_by"},
    {"v_convergence", "design iteration rank candidate mean n experiments_used"},
    {"v_design_scores",
     "design mission method repetition candidate source purpose pair instance seed score"},
    {"v_designs",
     "design mission method repetition seed state budget used iteration best_candidate best_mean "
     "reason flavour campaign name"},
    {"v_eliminations", "design candidate iteration step pair rank_sum reason"},
    {"v_evaluations",
     "id design candidate purpose pair instance seed iteration status score time bound wall_ms "
     "worker attempt source used state_digest"},
    {"v_failures",
     "id design candidate purpose pair instance seed iteration attempt worker host reason command "
     "output errors at"},
    {"v_iterations",
     "design iteration planned budget configurations elites soft_restart postselection"},
    {"v_leaderboard",
     "mission rank design method repetition candidate test_mean test_runs race_mean"},
    {"v_module_frequency", "mission method module avg_occurrences occurrence_rate"},
    {"v_parameters", "candidate design iteration parameter value"},
    {"v_race_steps",
     "design step iteration pair marker bound alive_before alive_after best mean_best evaluated "
     "used statistic p_value kendall_w spearman_rho qvar"},
    {"v_race_matrix", "design iteration step pair instance seed candidate score rank"},
    {"v_workers",
     "worker identity host pid slots build state done failed first_seen last_seen job cpu client "
     "connections principal"},
    {"v_attempts", "id design candidate pair attempt worker host held_ms outcome at"},
    {"v_commands", "number at who kind design step budget"},
    {"v_calibrations", "kind subject valid_from valid_until rms uses sha256 file"},
    {"v_real_cycles", "id run cycle time_s robot x y theta kind"},
    {"v_real_issues", "id run number code text robot from_s to_s"},
    {"v_real_overrides", "id run number scoring verdict who reason at"},
    {"v_real_patches", "id run patch x y width_m height_m radius_m color"},
    {"v_real_robots",
     "id run robot name tag measured interpolated degraded missing longest_gap_s outliers scale "
     "residual_m sigma_m sigma_rad border_m too_close offset_calibration"},
    {"v_real_runs",
     "id run name candidate design mission source score verdict counts measured_verdict "
     "overridden_by reason biased recorded duration_s robots cameras scorings scored stored "
     "program "
     "key"},
    {"v_real_samples",
     "id run number video frame time_s tag u0 v0 u1 v1 u2 v2 u3 v3 hamming margin robot x y theta "
     "use"},
    {"v_real_scores", "id run scoring score verdict biased reasons at program report"},
    {"v_real_videos",
     "id run video camera file width height frames damaged_frames time_source sha256 "
     "camera_calibration place_calibration"},
};

/// Two designs of one mission, worked out by hand: three candidates on two pairs.
SyntheticCampaign by_hand() {
  SyntheticCampaign made;
  made.campaign = {.name = "hand", .digest = "d", .deciding = "{}", .file = "", .seed = 1};
  std::vector<Row> rows;
  for (std::int64_t d = 1; d <= 2; ++d) {
    made.designs.push_back({.id = {d}, .mission = "m", .method = "w", .repetition = d});
    const CandidateId best = candidate_id({d}, 1);
    const std::vector<std::vector<double>> scores{{4, 6}, {4, 5}, {1}};
    for (std::size_t c = 0; c < scores.size(); ++c) {
      CandidateRow candidate;
      candidate.id = candidate_id({d}, static_cast<std::int64_t>(c + 1));
      candidate.iteration = 1;
      candidate.parameters = R"({"tau":5,"behaviour":"stop"})";
      candidate.modules = d == 1 ? R"({"stop":2})" : R"({"stop":1,"exploration":1})";
      rows.emplace_back(candidate);
      CandidateTotalsRow totals{.candidate = candidate.id};
      for (std::size_t p = 0; p < scores[c].size(); ++p) {
        EvaluationRow row;
        row.key = {candidate.id, Purpose::Race, static_cast<std::int64_t>(p + 1)};
        row.iteration = 1;
        row.score = scores[c][p];
        row.source = "rvr";
        row.wall_us = 1500;
        rows.emplace_back(row);
        ++totals.runs;
        totals.score_sum += row.score;
      }
      rows.emplace_back(totals);
    }
    for (std::int64_t step = 1; step <= 2; ++step) {
      rows.emplace_back(PairRow{.design = {d}, .number = step, .instance = 1, .seed = 70 + step});
      RaceStepRow row;
      row.design = {d};
      row.step = row.pair = step;
      row.iteration = 1;
      row.used = 3 * step - (step - 1);
      rows.emplace_back(row);
    }
    rows.emplace_back(EliminationRow{
        .candidate = candidate_id({d}, 3), .iteration = 1, .step = 1, .reason = "test"});
    rows.emplace_back(EliteRow{
        .design = {d}, .iteration = 1, .rank = 1, .candidate = best, .mean = 5, .runs = 2});
    EvaluationRow test;
    test.key = {best, Purpose::Test, 1};
    test.score = static_cast<double>(d);
    test.source = "rvr";
    rows.emplace_back(PairRow{
        .design = {d}, .purpose = Purpose::Test, .number = 1, .instance = 1, .seed = 90 + d});
    rows.emplace_back(test);
    rows.emplace_back(DesignStateRow{.design = {d},
                                     .state = DesignState::Finished,
                                     .used = 5,
                                     .iteration = 1,
                                     .best = best,
                                     .best_mean = 5,
                                     .reason = "budget used"});
  }
  made.batches.push_back(std::move(rows));
  return made;
}

struct ViewsTest : testing::Test {
  TemporaryFolder folder;
  std::unique_ptr<StoreReader> reader;

  void SetUp() override {
    const SyntheticCampaign campaign = by_hand();
    {
      auto store = open_store(folder / "s.db", campaign);
      for (const auto& batch : campaign.batches)
        store->append(batch);
    }
    reader = open_reader(folder / "s.db");
  }
  std::vector<Cells> all(const std::string& sql) { return cells_of(*reader, sql); }
};

TEST_F(ViewsTest, HaveTheColumnsThatScriptsRelyOn) {
  std::map<std::string, std::string> found;
  for (const Cells& name : all("SELECT name FROM sqlite_schema WHERE type = 'view' AND name LIKE "
                               "'v\\_%' ESCAPE '\\'")) {
    std::string& columns = found[name[0]];
    for (const Cells& row : all("SELECT name FROM pragma_table_info('" + name[0] + "')")) {
      columns += (columns.empty() ? "" : " ") + row[0];
    }
  }
  EXPECT_EQ(found, kColumns);
}

TEST_F(ViewsTest, ShowDesignsWithNamesForNumbers) {
  EXPECT_THAT(all("SELECT design, state, used, best_candidate, best_mean FROM v_designs"),
              ElementsAre(Cells{"1", "finished", "5", "1", "5"},
                          Cells{"2", "finished", "5", "1000001", "5"}));
  EXPECT_THAT(all("SELECT state, designs_finished, used, candidates, evaluations"
                  " FROM v_campaign_status"),
              ElementsAre(Cells{"running", "2", "10", "6", "12"}));
}

TEST_F(ViewsTest, ShowCandidatesWithTheirMeansAndWhenTheyWereDropped) {
  EXPECT_THAT(
      all("SELECT candidate, number, runs, mean, eliminated_at FROM v_candidates"
          " WHERE design = 2"),
      ElementsAre(Cells{"1000001", "1", "2", "5", "NULL"},
                  Cells{"1000002", "2", "2", "4.5", "NULL"}, Cells{"1000003", "3", "1", "1", "1"}));
  EXPECT_THAT(all("SELECT candidate, step, reason FROM v_eliminations WHERE design = 1"),
              ElementsAre(Cells{"3", "1", "test"}));
}

TEST_F(ViewsTest, ShowEvaluationsWithSeedPurposeAndSource) {
  EXPECT_THAT(all("SELECT id, purpose, seed, status, score, wall_ms, source, used"
                  " FROM v_evaluations WHERE candidate = 1"),
              ElementsAre(Cells{"e100001", "race", "71", "ok", "4", "1.5", "rvr", "1"},
                          Cells{"e100002", "race", "72", "ok", "6", "1.5", "rvr", "1"},
                          Cells{"e100001t", "test", "91", "ok", "1", "0", "rvr", "1"}));
  EXPECT_THAT(all("SELECT design, source, seed, score FROM v_design_scores"),
              ElementsAre(Cells{"1", "rvr", "91", "1"}, Cells{"2", "rvr", "92", "2"}));
  EXPECT_TRUE(all("SELECT * FROM v_failures").empty());
}

TEST_F(ViewsTest, RankTheRacersOfEachStepAndShareTies) {
  EXPECT_THAT(all("SELECT step, candidate, rank FROM v_race_matrix WHERE design = 1"
                  " ORDER BY step, candidate"),
              ElementsAre(Cells{"1", "1", "1.5"}, Cells{"1", "2", "1.5"}, Cells{"1", "3", "3"},
                          Cells{"2", "1", "1"}, Cells{"2", "2", "2"}));
}

TEST_F(ViewsTest, OrderTheWinnersOfAMissionByTheirTests) {
  EXPECT_THAT(all("SELECT rank, design, test_mean, race_mean FROM v_leaderboard"),
              ElementsAre(Cells{"1", "2", "2", "5"}, Cells{"2", "1", "1", "5"}));
  EXPECT_THAT(all("SELECT design, rank, mean, n, experiments_used FROM v_convergence"),
              ElementsAre(Cells{"1", "1", "5", "2", "5"}, Cells{"2", "1", "5", "2", "5"}));
}

TEST_F(ViewsTest, CountTheModulesOfWinnersWithZeroForThoseThatLackOne) {
  EXPECT_THAT(all("SELECT * FROM v_module_frequency"),
              ElementsAre(Cells{"m", "w", "exploration", "0.5", "0.5"},
                          Cells{"m", "w", "stop", "1.5", "1"}));
}

TEST_F(ViewsTest, ShowParametersInLongForm) {
  EXPECT_THAT(all("SELECT parameter, value FROM v_parameters WHERE candidate = 1"),
              ElementsAre(Cells{"tau", "5"}, Cells{"behaviour", "stop"}));
}

/// What SQLite goes through row by row in a query for some part of a view.
std::vector<std::string> scans(const std::filesystem::path& path, const std::string& sql) {
  const sqlite::Connection connection(path.string(), SQLITE_OPEN_READONLY);
  sqlite::Statement plan(connection, "EXPLAIN QUERY PLAN " + sql);
  std::vector<std::string> found;
  while (plan.step()) {
    const std::string detail = plan.text(3);
    const bool of_a_text = detail.find("VIRTUAL TABLE") != std::string::npos;
    if (detail.starts_with("SCAN") && !of_a_text) found.push_back(detail);
  }
  return found;
}

TEST_F(ViewsTest, OfOneDesignReadTheRowsOfThatDesignAlone) {
  for (const std::string view : {"v_candidates", "v_parameters", "v_evaluations", "v_eliminations",
                                 "v_race_steps", "v_iterations"}) {
    EXPECT_THAT(scans(folder / "s.db", "SELECT * FROM " + view + " WHERE design = 2"), IsEmpty())
        << view;
  }
  for (const std::string view : {"v_candidates", "v_parameters", "v_evaluations"}) {
    EXPECT_THAT(scans(folder / "s.db", "SELECT * FROM " + view + " WHERE candidate = 2"), IsEmpty())
        << view;
  }
}

TEST_F(ViewsTest, OfOneRealRunReadTheRowsOfThatRunAlone) {
  for (const std::string view :
       {"v_real_runs", "v_real_scores", "v_real_overrides", "v_real_videos", "v_real_robots",
        "v_real_cycles", "v_real_samples", "v_real_patches", "v_real_issues"}) {
    EXPECT_THAT(scans(folder / "s.db", "SELECT * FROM " + view + " WHERE run = 2"), IsEmpty())
        << view;
  }
  EXPECT_THAT(scans(folder / "s.db", "SELECT * FROM v_real_runs WHERE candidate = 2"), IsEmpty());
  // Joins, too, go by keys: the view is never made as a whole.
  EXPECT_THAT(scans(folder / "s.db",
                    "SELECT e.score FROM v_candidates AS c JOIN v_evaluations AS e"
                    " ON e.candidate = c.candidate WHERE c.design = 2"),
              IsEmpty());
}

TEST_F(ViewsTest, TheRaceMatrixOfADesignIterationOrStepReadsNothingElse) {
  for (const std::string also : {"", " AND iteration = 1", " AND step = 2"}) {
    EXPECT_THAT(scans(folder / "s.db", "SELECT * FROM v_race_matrix WHERE design = 2" + also),
                testing::Each(testing::AnyOf("SCAN r", testing::StartsWith("SCAN (subquery"),
                                             "SCAN v_race_matrix")))
        << also;
  }
}

}  // namespace
}  // namespace swarmsmith
