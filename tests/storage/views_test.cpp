#include <fmt/format.h>
#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "sim/control/flavour.h"
#include "sim/control/machine_text.h"
#include "storage/internal/machine_parts.h"
#include "storage/internal/sqlite.h"
#include "tests/analysis/machines/machines_to_draw.h"
#include "tests/storage/fixture.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

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
    {"v_module_frequency",
     "mission method module avg_occurrences occurrence_rate avg_reachable reachable_rate"},
    {"v_modules", "candidate design module occurrences reachable"},
    {"v_states", "candidate design state behaviour parameter reachable"},
    {"v_transitions", "candidate design state transition target condition p w label reachable"},
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
    {"v_real_checks", "id run number name subject outcome value bound unit catches reason"},
    {"v_real_cycles", "id run cycle time_s robot x y theta kind"},
    {"v_real_issues", "id run number code text robot from_s to_s"},
    {"v_real_log_cycles",
     "id run cycle time_s robot act state left_mps right_mps late_ms age_proximity_ms "
     "age_ground_ms "
     "age_neighbours_ms age_light_ms drawn event clock_s"},
    {"v_real_logs",
     "id run robot name file state verdict reasons stepped held skipped clock_offset_s latency_s "
     "latency_error_s latency_reason agreement machine_digest host program scheduling head"},
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

/// Nothing leads to its second state.
constexpr const char* kTwoStops = "--nstates 2 --s0 1 --s1 1 --n1 1 --n1x0 0 --c1x0 0 --p1x0 0.5";
constexpr const char* kStopThenExplore =
    "--nstates 2 --s0 1 --n0 1 --n0x0 0 --c0x0 6 --p0x0 0.25 --l0x0 2 --s1 0 --rwm1 5";

/// Two designs of one mission, worked out by hand: three candidates on two pairs.
SyntheticCampaign by_hand() {
  SyntheticCampaign made;
  made.campaign = {.name = "hand", .digest = "d", .deciding = "{}", .file = "", .seed = 1};
  std::vector<Row> rows;
  for (std::int64_t d = 1; d <= 2; ++d) {
    made.designs.push_back(
        {.id = {d}, .mission = "m", .method = "w", .flavour = "watermelon", .repetition = d});
    const CandidateId best = candidate_id({d}, 1);
    const std::vector<std::vector<double>> scores{{4, 6}, {4, 5}, {1}};
    for (std::size_t c = 0; c < scores.size(); ++c) {
      CandidateRow candidate;
      candidate.id = candidate_id({d}, static_cast<std::int64_t>(c + 1));
      candidate.iteration = 1;
      candidate.parameters = R"({"tau":5,"behaviour":"stop"})";
      candidate.machine = d == 1 ? kTwoStops : kStopThenExplore;
      candidate.modules =
          d == 1 ? R"({"stop":2,"black_floor":1})" : R"({"stop":1,"exploration":1,"color":1})";
      rows.emplace_back(candidate);
      CandidateTotalsRow totals{.candidate = candidate.id};
      for (std::size_t p = 0; p < scores[c].size(); ++p) {
        EvaluationRow row;
        row.key = {candidate.id, Purpose::Race, static_cast<std::int64_t>(p + 1)};
        row.iteration = 1;
        row.measured.score = scores[c][p];
        row.source = "rvr";
        row.measured.wall_us = 1500;
        rows.emplace_back(row);
        ++totals.runs;
        totals.score_sum += row.measured.score;
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
    test.measured.score = static_cast<double>(d);
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

struct ViewsTest : FilledStore {
  ViewsTest() : FilledStore(by_hand()) {}

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
              ElementsAre(Cells{"m", "w", "black_floor", "0.5", "0.5", "0", "0"},
                          Cells{"m", "w", "color_detection", "0.5", "0.5", "0.5", "0.5"},
                          Cells{"m", "w", "exploration", "0.5", "0.5", "0.5", "0.5"},
                          Cells{"m", "w", "stop", "1.5", "1", "1", "1"}));
}

TEST_F(ViewsTest, TakeMachinesApart) {
  EXPECT_THAT(all("SELECT * FROM v_states WHERE candidate IN (1, 1000001)"),
              ElementsAre(Cells{"1", "1", "0", "stop", "NULL", "1"},
                          Cells{"1", "1", "1", "stop", "NULL", "0"},
                          Cells{"1000001", "2", "0", "stop", "NULL", "1"},
                          Cells{"1000001", "2", "1", "exploration", "5", "1"}));
  EXPECT_THAT(all("SELECT * FROM v_transitions WHERE candidate IN (1, 1000001)"),
              ElementsAre(Cells{"1", "1", "1", "0", "0", "black_floor", "0.5", "NULL", "NULL", "0"},
                          Cells{"1000001", "2", "0", "0", "1", "color_detection", "0.25", "NULL",
                                "red", "1"}));
  EXPECT_THAT(
      all("SELECT * FROM v_modules WHERE candidate = 1"),
      ElementsAre(Cells{"1", "1", "black_floor", "1", "0"}, Cells{"1", "1", "stop", "2", "1"}));
}

/// A store of one finished design a text.
struct MachineViewsTest : testing::Test {
  TemporaryFolder folder;
  std::unique_ptr<StoreReader> reader;
  std::string file;  ///< the campaign's text

  void store(const std::vector<std::pair<std::string, std::string>>& flavours_and_texts) {
    SyntheticCampaign made;
    made.campaign = {.name = "machines", .digest = "d", .deciding = "{}", .file = file, .seed = 1};
    std::vector<Row> rows;
    for (const auto& [flavour, text] : flavours_and_texts) {
      const DesignId id{static_cast<std::int64_t>(made.designs.size()) + 1};
      made.designs.push_back({.id = id, .mission = "m", .method = flavour, .flavour = flavour});
      CandidateRow candidate;
      candidate.id = candidate_id(id, 1);
      candidate.machine = text;
      candidate.parameters = candidate.modules = "{}";
      rows.emplace_back(candidate);
      rows.emplace_back(DesignStateRow{
          .design = id, .state = DesignState::Finished, .best = candidate.id, .reason = "budget"});
    }
    {
      auto store = open_store(folder / "s.db", made);
      store->append(std::move(rows));
    }
    reader = open_reader(folder / "s.db");
  }
  std::vector<Cells> all(const std::string& sql) { return cells_of(*reader, sql); }
};

TEST_F(MachineViewsTest, AModuleThatAFlavourLacksHasNoCount) {
  store({{"chocolate", "--nstates 1 --s0 2"}, {"watermelon", "--nstates 1 --s0 2 --att0 1.5"}});
  EXPECT_THAT(all("SELECT method, module, avg_occurrences, reachable_rate FROM v_module_frequency"),
              ElementsAre(Cells{"chocolate", "attraction", "0", "0"},
                          Cells{"chocolate", "phototaxis", "1", "1"},
                          Cells{"watermelon", "attraction", "1", "1"},
                          Cells{"watermelon", "phototaxis", "NULL", "NULL"}));
}

TEST_F(MachineViewsTest, TreesHaveModulesAndNetworksHaveNone) {
  store({{"watermelon",
          "--nroot 3 --nchildroot 2 --n0 0 --nchild0 2 --n00 6 --c00 0 --p00 0.5 --n01 5 --a01 2 "
          "--att01 2.1 --p01 0 --n1 0 --nchild1 2 --n10 6 --c10 5 --p10 0.26 --n11 5 --a11 1 "
          "--p11 0"},
         {"chocolate",
          "--nroot 3 --nchildroot 1 --n0 0 --nchild0 2 --n00 6 --c00 0 --p00 1 --n01 5 "
          "--a01 4 --att01 2 --p01 0"},
         {"watermelon-argos3", "--network rvr-gray --weights 0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0"}});
  EXPECT_THAT(
      all("SELECT * FROM v_modules WHERE design = 1 ORDER BY module"),
      ElementsAre(Cells{"1", "1", "attraction", "1", "1"}, Cells{"1", "1", "black_floor", "1", "1"},
                  Cells{"1", "1", "fixed_probability", "1", "1"},
                  Cells{"1", "1", "stop", "1", "1"}));
  EXPECT_THAT(
      all("SELECT method, module, avg_occurrences, reachable_rate FROM v_module_frequency"),
      ElementsAre(
          Cells{"chocolate", "attraction", "1", "1"}, Cells{"chocolate", "black_floor", "1", "1"},
          Cells{"chocolate", "fixed_probability", "0", "0"}, Cells{"chocolate", "stop", "0", "0"},
          Cells{"watermelon", "attraction", "1", "1"}, Cells{"watermelon", "black_floor", "1", "1"},
          Cells{"watermelon", "fixed_probability", "1", "1"},
          Cells{"watermelon", "stop", "1", "1"}));
  for (const std::string view : {"v_states", "v_transitions"})
    EXPECT_THAT(all("SELECT * FROM " + view), IsEmpty()) << view;
}

TEST(MachineParts, AreTheStatesThatTransitionsReachFromTheFirst) {
  const std::pair<const char*, const char*> cases[] = {
      {"", " 0 "},
      {"--nstates 2 --s0 1 --n0 1", " 0 "},
      // A jump leaves out the state itself.
      {"--n0x0 0", " 0 1 "},
      {"--n0x0 1 --n1x0 0", " 0 2 "},
      {"--n1x0 1 --n0x0 0", " 0 1 2 "},
      {"--n1x0 0 --n0x0 0", " 0 1 "},
      {"--n10x2 3 --n0x11 9", " 0 3 10 "},
      {"--n0x1", " 0 1 "},
      {"--n0x --nx0 4 --m0x0 5", " 0 "},
      {"--n0x0 0 --n0x1 2 --n3x0 3 --n4x0 0", " 0 1 3 4 "}};
  for (const auto& [text, states] : cases)
    EXPECT_EQ(reached_states(text), states) << text;
}

TEST(MachineParts, AreItsModulesAndThoseInStatesThatCanBeReached) {
  const std::pair<const char*, const char*> cases[] = {
      {"", "{}"},
      {"--nstates 2 --s0 1 --s1 1 --n0 1 --n0x0 0 --c0x0 3 --p0x0 4", R"({"c3":"1 1","s1":"2 2"})"},
      {"--s0 1 --s1 1 --s2 4 --c2x0 7 --c2x1 7", R"({"c7":"2 0","s1":"2 1","s4":"1 0"})"},
      {"--s0 1  --s12 3", R"({"s1":"1 1","s3":"1 0"})"},
      // Words of one letter, of a state's number alone, and of leaves of a tree.
      {"--s 1 --c0 5 --cx0 5 --a0 2 --att0 1.5 --a01 --t0 9", "{}"},
      {"--c00 5 --a01 2", R"({"c5":"1 1","s2":"1 0"})"},
      {"--nroot 3 --nchildroot 1 --n1 0 --c10 5 --a11 2 --c11 5", R"({"c5":"2 2","s2":"1 1"})"},
      {"--c10 5 --a11 2", R"({"c5":"1 0","s2":"1 0"})"}};
  for (const auto& [text, modules] : cases)
    EXPECT_EQ(module_counts(text), modules) << text;
}

TEST_F(MachineViewsTest, AreMadeOfFunctionsThatAQueryMayUseToo) {
  store({});
  EXPECT_THAT(all("SELECT reached_states('--n0x0 0'), module_counts('--s0 1'),"
                  " reached_states(NULL), module_counts(NULL)"),
              ElementsAre(Cells{" 0 1 ", R"({"s1":"1 1"})", "NULL", "NULL"}));
}

/// The rows that an ordinary client gets from the file's own views, sorted.
std::vector<Cells> rows_of_file(const std::filesystem::path& path, const std::string& sql) {
  sqlite::Connection file(path.string(), SQLITE_OPEN_READONLY);
  file.allow_views(true);
  std::vector<Cells> rows;
  sqlite::Statement row(file, sql);
  while (row.step()) {
    Cells& cells = rows.emplace_back();
    for (int i = 0; i < sqlite3_column_count(row.handle()); ++i) {
      const bool is_real = sqlite3_column_type(row.handle(), i) == SQLITE_FLOAT;
      cells.push_back(row.is_null(i) ? "NULL"
                      : is_real      ? fmt::format("{}", row.real(i))
                                     : row.text(i));
    }
  }
  std::ranges::sort(rows);
  return rows;
}

/// Our programs read some views in words of their own (lent_views.sql), for speed.
TEST_F(MachineViewsTest, SayTheSameToOurProgramsAndToOthers) {
  SyntheticCampaign made = synthetic_campaign({.designs = 2, .iterations = 2, .candidates = 60});
  std::vector<Row> machines;
  const std::vector<std::string> texts{
      kTwoStops, kStopThenExplore, "--nstates 1 --s0 0 --rwm0 4",
      // Nothing leads to state 1; 2 and 3 lead to each other; 4 to itself in a circle.
      "--nstates 5 --s0 2 --att0 1.5 --n0 1 --n0x0 1 --c0x0 0 --p0x0 1 --s1 3 --rep1 2 --n1 1 "
      "--n1x0 0 --c1x0 5 --p1x0 1 --s2 1 --n2 2 --n2x0 2 --c2x0 3 --p2x0 4 --w2x0 2.5 --n2x1 2 "
      "--c2x1 3 --p2x1 4 --w2x1 2.5 --s3 0 --rwm3 7 --n3 1 --n3x0 2 --c3x0 6 --p3x0 1 --l3x0 1 "
      "--s4 1 --n4 1 --n4x0 3 --c4x0 99 --p4x0 1",
      "--nroot 3 --nchildroot 2 --n0 0 --nchild0 3 --n00 6 --c00 0 --p00 0.5 --n01 6 --c01 3 "
      "--p01 1 --n02 5 --a02 2 --att02 2.1 --n1 0 --nchild1 2 --n10 6 --c10 5 --p10 0.26 --n11 5 "
      "--a11 1 --p11 0"};
  for (std::size_t i = 0; i < texts.size(); ++i) {
    CandidateRow row;
    row.id = candidate_id({1}, 500 + static_cast<std::int64_t>(i));
    row.iteration = 1;
    row.machine = texts[i];
    row.parameters = row.modules = "{}";
    machines.emplace_back(row);
  }
  for (DesignRow& design : made.designs)
    design.flavour = "watermelon";
  {
    auto store = open_store(folder / "s.db", made);
    for (const auto& batch : made.batches)
      store->append(batch);
    store->append(std::move(machines));
  }
  reader = open_reader(folder / "s.db");
  for (const std::string view : {"v_states", "v_transitions", "v_modules", "v_module_frequency",
                                 "module_place", "v_race_matrix"}) {
    const std::string sql = "SELECT * FROM " + view;
    std::vector<Cells> ours = all(sql);
    std::ranges::sort(ours);
    EXPECT_FALSE(ours.empty()) << view;
    EXPECT_EQ(ours, rows_of_file(folder / "s.db", sql)) << view;
  }
}

/// As tables, views and indexes of a store are known: by what SQLite plans. Ranks are made of one
/// iteration at a time, however many there are.
TEST_F(MachineViewsTest, RankWithoutSortingTheWholeStore) {
  store({});
  bool sorts_a_part = false;
  for (const Cells& row : all("EXPLAIN QUERY PLAN SELECT * FROM v_race_matrix")) {
    EXPECT_THAT(row.back(), Not(HasSubstr("USE TEMP B-TREE FOR ORDER BY")));
    EXPECT_THAT(row.back(), Not(HasSubstr("AUTOMATIC")));
    // SQLite 3.40 says the former, 3.46 the latter.
    sorts_a_part |= row.back() == "USE TEMP B-TREE FOR RIGHT PART OF ORDER BY" ||
                    row.back().starts_with("USE TEMP B-TREE FOR LAST ");
  }
  EXPECT_TRUE(sorts_a_part);
}

TEST_F(MachineViewsTest, ParametersOfAProgramAreNoMachine) {
  store({{"", "--alpha 2 --s0 1 --text \"a b\""}, {"", "-n0x0 --nstates x"}, {"", ""}});
  for (const std::string view : {"v_states", "v_transitions", "v_modules", "v_module_frequency"})
    EXPECT_THAT(all("SELECT * FROM " + view), IsEmpty()) << view;
}

TEST_F(MachineViewsTest, KnowTheNumbersOfEveryFlavour) {
  store({});
  std::vector<Cells> names;
  for (const Flavour* flavour : all_flavours()) {
    for (const ModuleSpec& spec : flavour->behaviours)
      names.push_back(
          {flavour->name, "s", std::to_string(spec.number), std::string(id_of(spec.module))});
    for (const ModuleSpec& spec : flavour->conditions)
      names.push_back(
          {flavour->name, "c", std::to_string(spec.number), std::string(id_of(spec.module))});
    for (const LabelSpec& spec : flavour->floor.labels)
      names.push_back(
          {flavour->name, "l", std::to_string(spec.number), std::string(name_of(spec.label))});
  }
  EXPECT_THAT(all("SELECT * FROM flavour_name"), testing::UnorderedElementsAreArray(names));
}

TEST_F(MachineViewsTest, KnowTheModulesOfAFlavourOfTheCampaignsOwn) {
  file =
      "format = 1\n[[method]]\nname = \"m\"\n[method.flavour]\nname = \"mine\"\n"
      "base = \"watermelon\"\nstates = 16\n[method.flavour.behaviours]\nstop = { number = 3 }\n"
      "exploration = { number = 0 }\n"
      "wave = { number = 12, kind = \"external\", parameters = [\n"
      "{ name = \"speed\", token = \"vel\", type = \"real\", range = [0, 1] } ] }\n";
  std::string text = "--nstates 12";
  for (int i = 0; i < 12; ++i) {
    const std::string own = std::to_string(i);
    text += " --s" + own +
            (i == 1    ? " 3"
             : i == 11 ? " 12 --vel11 0.5"
                       : " 0 --rwm" + own + " 4") +
            " --n" + own + " 1 --n" + own + "x0 10 --c" + own + "x0 5 --p" + own + "x0 0.25";
  }
  store({{"mine", text}});
  EXPECT_THAT(all("SELECT state, behaviour, parameter FROM v_states WHERE state IN (0, 1, 10, 11) "
                  "ORDER BY state"),
              ElementsAre(Cells{"0", "exploration", "4"}, Cells{"1", "stop", "NULL"},
                          Cells{"10", "exploration", "4"}, Cells{"11", "wave", "0.5"}));
  EXPECT_THAT(all("SELECT module, occurrences FROM v_modules ORDER BY module"),
              ElementsAre(Cells{"exploration", "10"}, Cells{"fixed_probability", "12"},
                          Cells{"stop", "1"}, Cells{"wave", "1"}));
}

TEST_F(MachineViewsTest, AgreeWithTheProgramsOnMachinesAtRandom) {
  Rng rng(7);
  std::vector<Machine> machines;
  std::vector<std::pair<std::string, std::string>> texts;
  for (int i = 0; i < 200; ++i) {
    machines.push_back(random_machine(rng, 1 + i % watermelon().most_states));
    texts.emplace_back("watermelon", print_machine(machines.back(), watermelon()));
  }
  store(texts);
  for (std::size_t d = 0; d < machines.size(); ++d) {
    const std::vector<bool> reached = reachable_states(machines[d]);
    std::vector<Cells> states;
    std::vector<Cells> transitions;
    for (std::size_t s = 0; s < reached.size(); ++s) {
      const State& state = machines[d].states[s];
      const std::string number = std::to_string(s);
      const std::string reachable = reached[s] ? "1" : "0";
      states.push_back({number, std::string(id_of(module_of(state.behaviour))), reachable});
      for (std::size_t t = 0; t < state.transitions.size(); ++t) {
        const Transition& transition = state.transitions[t];
        transitions.push_back({number, std::to_string(t), std::to_string(transition.target),
                               std::string(id_of(module_of(transition.condition))), reachable});
      }
    }
    const std::string of_design = " WHERE design = " + std::to_string(d + 1);
    EXPECT_EQ(all("SELECT state, behaviour, reachable FROM v_states" + of_design), states);
    EXPECT_EQ(all("SELECT state, transition, target, condition, reachable FROM v_transitions" +
                  of_design),
              transitions);
  }
}

TEST_F(ViewsTest, ShowParametersInLongForm) {
  EXPECT_THAT(all("SELECT parameter, value FROM v_parameters WHERE candidate = 1"),
              ElementsAre(Cells{"tau", "5"}, Cells{"behaviour", "stop"}));
}

/// What SQLite goes through row by row in a query for some part of a view.
std::vector<std::string> scans(const std::filesystem::path& path, const std::string& sql) {
  sqlite::Connection connection(path.string(), SQLITE_OPEN_READONLY);
  connection.allow_views(true);
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

TEST_F(ViewsTest, MachinesOfWinnersReadTheRowsOfTheseAlone) {
  // As analysis/records and the end of `run` ask. A LEFT JOIN would make the whole view.
  EXPECT_THAT(scans(folder / "s.db",
                    "SELECT d.design, (SELECT c.fsm_config FROM v_candidates AS c"
                    " WHERE c.candidate = d.best_candidate) FROM v_designs AS d"),
              ElementsAre("SCAN design"));
  EXPECT_THAT(scans(folder / "s.db", "SELECT * FROM v_states WHERE candidate = 2"),
              Not(Contains(StartsWith("SCAN c"))));
  EXPECT_THAT(scans(folder / "s.db", "SELECT * FROM v_modules WHERE candidate = 2"),
              Not(Contains(StartsWith("SCAN c"))));
}

TEST_F(ViewsTest, OfOneRealRunReadTheRowsOfThatRunAlone) {
  for (const std::string view :
       {"v_real_runs", "v_real_scores", "v_real_overrides", "v_real_videos", "v_real_robots",
        "v_real_cycles", "v_real_samples", "v_real_patches", "v_real_issues", "v_real_logs",
        "v_real_log_cycles", "v_real_checks"}) {
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
                testing::Each(testing::AnyOf("SCAN t", StartsWith("SCAN (subquery"))))
        << also;
  }
}

}  // namespace
}  // namespace swarmsmith
