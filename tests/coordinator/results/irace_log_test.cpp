#include "coordinator/results/irace_log.h"

#include "coordinator/results/irace_log_rows.h"
#include "coordinator/results/stored_irace_log.h"
#include "storage/store.h"
#include "storage/store_at_rest.h"
#include "tests/support/checks.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

using Texts = std::map<std::string, std::string>;

/// The example log of R's irace 3.5, as the converter writes it.
Texts example() {
  Texts texts;
  for (const std::string& name : irace_log_files())
    texts.emplace(name, whole_file(SWARMSMITH_TEST_DATA "/irace/log-acotsp/" + name));
  return texts;
}

template <class T>
std::vector<T> rows_of(const Addition& addition) {
  std::vector<T> rows;
  for (const Row& row : addition.rows)
    if (const auto* one = std::get_if<T>(&row)) rows.push_back(*one);
  return rows;
}

/// Three configurations of a parameter x, two pairs; in the second iteration only 2 and 3 race.
Texts by_hand() {
  return {
      {"log.csv",
       "key,value\nirace_version,4.4\ncompleted,Budget\nseed,42\n"
       "max_experiments,20\niterations,2\nsoft_restart,2\n"},
      {"parameters.csv", "name,type,switch\nx,r,--x \nkind,c,--\n"},
      {"configurations.csv", "id,parent,x,kind\n1,,0.5,a\n2,,1,a\n3,2,,\"b\"\"\"\n"},
      {"pairs.csv", "kind,pair,instance,seed\nrace,1,1,11\nrace,2,2,12\ntest,1,1,99\n"},
      {"runs.csv",
       "iteration,pair,configuration,cost,time,bound\n"
       "1,1,1,4,,\n1,1,2,3,1.5,9\n2,2,2,5,,\n2,2,3,1,,\n2,1,3,Inf,,\n"},
      {"elites.csv", "iteration,rank,configuration\n1,1,2\n2,1,2\n"},
      {"tests.csv", "pair,configuration,cost\n1,2,6\n"},
  };
}

TEST(IraceLog, BecomesTheRowsOfADesign) {
  const auto log = value_of(read_irace_log(by_hand()));
  const auto addition = value_of(
      irace_log_addition(log, {.campaign = "theirs", .flavour = {}, .designs = {{.id = {1}}}}));
  EXPECT_EQ(addition.designs.front().row.id, DesignId{2});
  EXPECT_EQ(addition.designs.front().row.seed, 42);
  const auto candidates = rows_of<CandidateRow>(addition);
  ASSERT_EQ(candidates.size(), 3U);
  EXPECT_EQ(candidates[0].machine, "--x 0.5 --a");
  EXPECT_EQ(candidates[0].parameters, R"({"x":0.5,"kind":"a"})");
  EXPECT_EQ(candidates[2].parameters, R"({"kind":"b\""})");
  EXPECT_EQ(candidates[2].parent, candidate_id({2}, 2));
  EXPECT_EQ(candidates[2].iteration, 2);
  const auto evaluations = rows_of<EvaluationRow>(addition);
  ASSERT_EQ(evaluations.size(), 6U);
  EXPECT_EQ(evaluations[1].measured.score, -3);
  EXPECT_EQ(evaluations[1].measured.time, 1.5);
  EXPECT_EQ(evaluations[1].bound, 9);
  EXPECT_EQ(evaluations[4].status, EvaluationStatus::Rejected);
  EXPECT_EQ(evaluations[5].key.purpose, Purpose::Test);
  EXPECT_EQ(evaluations[5].measured.score, -6);
  const auto iterations = rows_of<IterationRow>(addition);
  EXPECT_FALSE(iterations[0].soft_restart);
  EXPECT_TRUE(iterations[1].soft_restart);
  EXPECT_EQ(iterations[1].elites, 1);
}

TEST(IraceLog, WorksOutWhoWasAliveAndWhoLeft) {
  const auto addition = value_of(irace_log_addition(
      *read_irace_log(by_hand()), {.campaign = "theirs", .flavour = {}, .designs = {}}));
  std::vector<std::string> steps;
  for (const RaceStepRow& step : rows_of<RaceStepRow>(addition)) {
    steps.push_back(std::to_string(step.iteration) + "/" + std::to_string(step.pair) + ": " +
                    std::to_string(step.alive_before) + " to " + std::to_string(step.alive_after) +
                    ", best " + to_string(step.best) + ", used " + std::to_string(step.used));
  }
  // The elite brings its score on pair 1, on which 3 is rejected.
  EXPECT_THAT(steps, ElementsAre("1/1: 2 to 1, best c2, used 2", "2/2: 2 to 2, best c3, used 4",
                                 "2/1: 2 to 1, best c2, used 5"));
  const auto gone = rows_of<EliminationRow>(addition);
  ASSERT_EQ(gone.size(), 2U);
  EXPECT_EQ(gone[0].candidate, CandidateId{1});
  EXPECT_EQ(gone[0].rank_sum, 2);
  EXPECT_EQ(gone[0].reason, "not kept");
  EXPECT_EQ(gone[1].candidate, CandidateId{3});
  EXPECT_EQ(gone[1].rank_sum, 1 + 2);
  EXPECT_EQ(gone[1].reason, "rejected");
  const auto elites = rows_of<EliteRow>(addition);
  EXPECT_EQ(elites[0].mean, -3);
  EXPECT_EQ(elites[1].mean, -4);
  EXPECT_EQ(elites[1].runs, 2);
  EXPECT_EQ(rows_of<DesignStateRow>(addition).front().best, CandidateId{2});
}

TEST(IraceLog, ScoresOfALaterRaceBringNoConfigurationBackIntoAnEarlierOne) {
  Texts texts = by_hand();
  texts["pairs.csv"] += "race,3,1,13\nrace,4,2,14\n";
  // The test on pair 2 drops the elite 1; the post-selection takes it again, with pair 3.
  texts["runs.csv"] =
      "iteration,pair,configuration,cost,time,bound\n"
      "1,1,1,4,,\n1,1,2,3,,\n2,2,1,9,,\n2,2,2,5,,\n2,2,3,1,,\n2,3,2,5,,\n2,3,3,1,,\n"
      "3,3,1,0,,\n3,4,1,2,,\n3,4,2,2,,\n3,4,3,1,,\n";
  texts["elites.csv"] = "iteration,rank,configuration\n1,1,2\n1,2,1\n2,1,3\n2,2,2\n3,1,3\n";
  const auto addition = value_of(irace_log_addition(
      *read_irace_log(texts), {.campaign = "theirs", .flavour = {}, .designs = {}}));
  std::vector<std::string> steps;
  for (const RaceStepRow& step : rows_of<RaceStepRow>(addition)) {
    steps.push_back(std::to_string(step.iteration) + "/" + std::to_string(step.pair) + ": " +
                    std::to_string(step.alive_before) + " to " + std::to_string(step.alive_after) +
                    ", best " + to_string(step.best));
  }
  EXPECT_THAT(steps,
              ElementsAre("1/1: 2 to 2, best c2", "2/2: 3 to 2, best c3", "2/3: 2 to 2, best c3",
                          "3/3: 3 to 3, best c1", "3/4: 3 to 1, best c1"));
  const auto gone = rows_of<EliminationRow>(addition);
  ASSERT_FALSE(gone.empty());
  EXPECT_EQ(gone.front().candidate, CandidateId{1});
  EXPECT_EQ(gone.front().iteration, 2);
  EXPECT_EQ(gone.front().reason, "test");
}

TEST(IraceLog, RunsThatEstimateATimeCountForTheFirstRace) {
  Texts texts = by_hand();
  texts["runs.csv"] =
      "iteration,pair,configuration,cost,time,bound\n"
      "0,1,1,4,,\n0,1,2,3,1.5,9\n1,2,2,5,,\n1,2,3,1,,\n2,1,3,Inf,,\n";
  const auto log = value_of(read_irace_log(texts));
  const auto addition =
      value_of(irace_log_addition(log, {.campaign = "theirs", .flavour = {}, .designs = {}}));
  EXPECT_EQ(rows_of<EvaluationRow>(addition).front().iteration, 1);
  EXPECT_EQ(rows_of<CandidateRow>(addition).front().iteration, 1);
  EXPECT_EQ(rows_of<IterationRow>(addition).front().budget, 4);
  texts["runs.csv"] += "-1,1,1,4,,\n";
  EXPECT_THAT(to_string(read_irace_log(texts).error().front()),
              HasSubstr("iterations count from 0"));
}

TEST(IraceLog, OfAnUnfinishedRunIsADesignThatStopped) {
  Texts texts = by_hand();
  texts["log.csv"] = "key,value\ncompleted,Incomplete\n";
  const auto addition = irace_log_addition(*read_irace_log(texts),
                                           {.campaign = "theirs", .flavour = {}, .designs = {}});
  EXPECT_EQ(rows_of<DesignStateRow>(*addition).front().state, DesignState::Stopped);
}

TEST(IraceLog, HasMachinesWhereAFlavourIsNamed) {
  Texts texts = by_hand();
  texts["parameters.csv"] = "name,type,switch\nn,i,--nstates \ns0,c,--s0 \n";
  texts["configurations.csv"] = "id,parent,n,s0\n1,,1,1\n2,,1,1\n3,2,1,1\n";
  const IraceImport known{.campaign = "theirs", .flavour = watermelon(), .designs = {}};
  const auto addition = value_of(irace_log_addition(*read_irace_log(texts), known));
  EXPECT_EQ(rows_of<CandidateRow>(addition).front().modules, R"({"stop":1})");
  const auto none = irace_log_addition(*read_irace_log(by_hand()), known);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().size(), 3U);
  EXPECT_THAT(to_string(none.error().front()), HasSubstr("configuration 1, token 4"));
}

TEST(IraceLog, NamesWhatDoesNotFitByTableAndLine) {
  Texts texts = by_hand();
  texts.erase("elites.csv");
  texts["runs.csv"] += "1,9,1,4,,\n1,1,7,4,,\n1,1,1,four,,\n1,1,1,-1e305,,\n";
  const auto log = read_irace_log(texts);
  ASSERT_FALSE(log);
  EXPECT_THAT(
      lines_of(log.error()),
      ElementsAre("runs.csv:7: there is no pair 9", "runs.csv:8: there is no configuration 7",
                  "runs.csv:9: column cost must be a number, not `four`",
                  HasSubstr("runs.csv:10: the cost -1e305 is beyond 1e300"),
                  "elites.csv: the log has no such table"));
}

TEST(IraceLog, HasNoIdsThatAStoreCannotNumber) {
  Texts texts = by_hand();
  texts["configurations.csv"] += "1000001,,1,a\n";
  const auto configurations = read_irace_log(texts);
  ASSERT_FALSE(configurations);
  EXPECT_THAT(lines_of(configurations.error()),
              Contains(HasSubstr("the configuration 1000001 is beyond 1000000, the most that a "
                                 "design can have")));
  texts = by_hand();
  texts["pairs.csv"] += "race,100000,1,5\n";
  const auto pairs = read_irace_log(texts);
  ASSERT_FALSE(pairs);
  EXPECT_THAT(lines_of(pairs.error()),
              Contains(HasSubstr("the pair 100000 is beyond 99999, the most that a candidate can "
                                 "run on")));
}

TEST(IraceLog, OfTheExampleHasItsNineHundredAndEightyOneRuns) {
  const auto log = value_of(read_irace_log(example()));
  EXPECT_EQ(log.version, "3.5.6863679");
  EXPECT_EQ(log.seed, 1406598565);
  EXPECT_EQ(log.configurations.size(), 157U);
  EXPECT_EQ(log.runs.size(), 981U);
  const auto addition =
      value_of(irace_log_addition(log, {.campaign = "acotsp", .flavour = {}, .designs = {}}));
  const auto iterations = rows_of<IterationRow>(addition);
  std::vector<std::int64_t> runs;
  for (const IterationRow& iteration : iterations)
    runs.push_back(iteration.budget);
  // table(experimentLog[, "iteration"]) in R.
  EXPECT_THAT(runs, ElementsAre(165, 160, 155, 195, 197, 73, 36));
  const auto evaluations = rows_of<EvaluationRow>(addition);
  EXPECT_EQ(evaluations.size(), 981U + 220U);
  EXPECT_EQ(evaluations.front().measured.score, -29098846);  // experiments[1, 1] in R
  const DesignStateRow state = rows_of<DesignStateRow>(addition).front();
  EXPECT_EQ(state.used, 981);
  EXPECT_EQ(state.best, CandidateId{155});  // the last of iterationElites in R
  EXPECT_EQ(state.reason, "Not enough budget to race more than the minimum configurations");
}

/// By hand, with everything that a store has no tables for, and texts that are hard to hold.
Texts with_settings() {
  Texts texts = by_hand();
  texts["parameters.csv"] =
      "name,type,switch,log,condition\nx,r,--x ,1,\nkind,c,\"'--\",0,\"x > 1 & \"\"a\"\" != "
      "\"\"b\"\"\"\n";
  texts["domains.csv"] =
      "parameter,value\nx,0.5\nx,\"min(y, 2)\"\nkind,a\nkind,\"b\"\"\"\nkind,''=1\n";
  texts["instances.csv"] = "kind,instance,name\nrace,1,\"in/a, b\"\nrace,2,in/c\ntest,1,t\n";
  texts["scenario.csv"] =
      "option,value\nelitist,TRUE\ntestNbElites,2\nforbidden,\"\"\"x == 1\"\"\"\nforbidden,\"\"\"x "
      "== "
      "2\"\"\"\n";
  return texts;
}

/// The log as a store gives it back that it was imported into.
IraceLog through_a_store(const IraceLog& log) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "log.db";
  const auto addition = irace_log_addition(log, {.campaign = "log", .flavour = {}, .designs = {}});
  auto store = StoreAtRest::open(file, StoreAtRest::IfMissing::Make);
  EXPECT_TRUE(store);
  EXPECT_TRUE((*store)->add(*addition));
  const auto reader = StoreReader::open(file);
  std::int64_t rows = 0;
  const auto again = stored_irace_log(**reader, {1}, [&](std::int64_t read) { rows = read; });
  EXPECT_TRUE(again) << to_string(again.error());
  EXPECT_GT(rows, 0);
  return *again;
}

TEST(IraceLog, IsPrintedAsTablesThatReadBackTheSame) {
  for (const Texts& texts : {by_hand(), with_settings(), example()}) {
    const auto log = value_of(read_irace_log(texts));
    const Texts printed = print_irace_log(log);
    EXPECT_EQ(printed.size(), irace_log_files().size());
    const auto again = value_of(read_irace_log(printed));
    EXPECT_EQ(print_irace_log(again), printed);
    EXPECT_EQ(again.runs.size(), log.runs.size());
  }
  const Texts printed = print_irace_log(*read_irace_log(with_settings()));
  EXPECT_THAT(printed.at("domains.csv"), HasSubstr("kind,''=1\n"));
  EXPECT_THAT(printed.at("runs.csv"), HasSubstr("2,1,3,Inf,,\n"));
  EXPECT_THAT(printed.at("configurations.csv"), HasSubstr("3,2,,\"b\"\"\"\n"));
}

TEST(IraceLog, ComesBackFromAStoreAsItWas) {
  for (const Texts& texts : {with_settings(), example()}) {
    const auto log = value_of(read_irace_log(texts));
    Texts expected = print_irace_log(log);
    Texts found = print_irace_log(through_a_store(log));
    for (const std::string& file : irace_log_files())
      EXPECT_EQ(found.at(file), expected.at(file)) << file;
  }
}

TEST(IraceLog, WithoutParametersInItsStoreIsRefused) {
  const TemporaryFolder folder;
  auto addition = irace_log_addition(*read_irace_log(by_hand()),
                                     {.campaign = "log", .flavour = {}, .designs = {}});
  addition->campaign->deciding = R"({"imported":"irace log","irace":"3.5","log":"x"})";
  ASSERT_TRUE(
      (*StoreAtRest::open(folder / "log.db", StoreAtRest::IfMissing::Make))->add(*addition));
  const auto reader = StoreReader::open(folder / "log.db");
  const auto none = [](std::int64_t) {};
  EXPECT_THAT(to_string(stored_irace_log(**reader, {1}, none).error()),
              HasSubstr("import its log into a new store"));
  EXPECT_EQ(stored_irace_log(**reader, {2}, none).error().kind, ErrorKind::NotFound);
}

}  // namespace
}  // namespace swarmsmith
