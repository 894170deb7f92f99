#include <cstdlib>
#include <nlohmann/json.hpp>

#include "cli/output/query_output.h"
#include "cli/run/campaign_result.h"
#include "tests/cli/cli_support.h"
#include "tests/storage/fixture.h"
#include "tests/support/checks.h"

namespace swarmsmith::cli {
namespace {

using nlohmann::json;

using Digest = WithStore;
using Ls = WithStore;
using Show = WithStore;
using Query = WithStore;
using Export = WithStore;
using Status = WithStore;
using Result = WithStore;

TEST_F(Digest, IsOneHexadecimalLine) {
  const Ran ran = run({"digest", store_});
  EXPECT_EQ(ran.code, 0);
  EXPECT_THAT(ran.out, testing::MatchesRegex("[0-9a-f]+\n"));
}

TEST_F(Digest, FindsItsStoreByWordOptionOrEnvironment) {
  const std::string wanted = run({"digest", store_}).out;
  EXPECT_EQ(run({"digest", "--store", store_}).out, wanted);
  ::setenv("SWARMSMITH_STORE", store_.c_str(), 1);
  EXPECT_EQ(run({"digest"}).out, wanted);
  ::unsetenv("SWARMSMITH_STORE");
  EXPECT_THAT(refusal({"digest"}), HasSubstr("no store given"));
}

TEST_F(Digest, ExitsWithThreeWhenTheStoreCannotBeUsed) {
  EXPECT_EQ(run({"digest", store_ + ".gone"}).code, 3);
  write_file(folder_ / "text.db", "this is a text and no store, long enough to be looked at\n");
  EXPECT_EQ(run({"digest", (folder_ / "text.db").string()}).code, 3);
}

TEST(FigureCommand, DrawsEachPageInTheFontThatWasAskedFor) {
  const TemporaryFolder folder;
  const SyntheticCampaign campaign = synthetic_campaign({.designs = 16, .iterations = 1});
  const std::string file = (folder / "many.db").string();
  fill_store(file, campaign);
  const std::string drawn = (folder / "all.pdf").string();
  const Ran ran = run({"figure", "machine", file, "-o", drawn, "--font", "DejaVu Serif"});
  if (ran.err.find("librsvg2-bin") != std::string::npos) GTEST_SKIP() << ran.err;
  ASSERT_EQ(ran.code, 0) << ran.err;
  const std::string pdf = whole_file(drawn);
  EXPECT_THAT(pdf, Not(HasSubstr("/Count 1\n"))) << "it has several pages";
  if (pdf.find("/FontName") == std::string::npos) GTEST_SKIP() << "the fonts are compressed";
  EXPECT_THAT(pdf, HasSubstr("+DejaVuSerif"));
  EXPECT_THAT(pdf, Not(HasSubstr("+DejaVuSans")));
}

TEST_F(Ls, ListsWithLettersBeforeIds) {
  const Ran ran = run_well({"ls", "designs", store_});
  EXPECT_THAT(ran.out, HasSubstr("d1      aggregation  watermelon"));
  EXPECT_THAT(ran.out, HasSubstr("finished"));
  EXPECT_THAT(run({"ls", "candidates", store_}).out, HasSubstr("c2"));
  EXPECT_THAT(run({"ls", "evaluations", store_}).out, HasSubstr("e100001t"));
  EXPECT_THAT(run({"ls", "elites", store_}).out, HasSubstr("c1"));
  EXPECT_EQ(run({"ls", "workers", store_}).code, 0);
}

TEST_F(Ls, TellsTheMeanOfTheTestsOnceThereAreSome) {
  EXPECT_THAT(run({"ls", "designs", store_}).out, testing::ContainsRegex("c1 +3 +1 tests?\n"));
  EXPECT_THAT(run({"ls", "elites", store_}).out, testing::ContainsRegex("test_mean"));
  const json design = json::parse(run({"ls", "designs", store_, "--json"}).out)["rows"][0];
  EXPECT_EQ(design["best_mean"], 2.5);  // as ever: of the race
  EXPECT_EQ(design["test_mean"], 3);
  EXPECT_EQ(design["test_runs"], 1);
}

TEST_F(Ls, FindsIdsAsTheyArePrinted) {
  const Ran ran = run({"ls", "candidates", store_, "--where", "candidate = 'c2'", "--json"});
  EXPECT_EQ(json::parse(ran.out)["rows"].size(), 1U) << ran.err;
  EXPECT_THAT(run({"query", "SELECT mission FROM v_designs WHERE design='d1'", store_}).out,
              HasSubstr("aggregation"));
}

TEST(ExplainDesign, SpentExperimentsAddUpToThoseUsed) {
  const TemporaryFolder folder;
  const std::string path = (folder / "s.db").string();
  const SyntheticCampaign campaign = synthetic_campaign({.designs = 1, .iterations = 4});
  fill_store(path, campaign);
  const json story = json::parse(run({"explain", "d1", path, "--json"}).out);
  std::int64_t spent = 0;
  for (const json& stage : story["stages"])
    spent += stage["spent"].get<std::int64_t>();
  EXPECT_EQ(story["stages"].size(), 4U);
  EXPECT_EQ(spent, story["used"]);
  EXPECT_THAT(run({"explain", "d1", path}).out, HasSubstr(" of at most "));
}

TEST_F(Ls, FiltersSortsAndLimits) {
  const Ran ran = run_well({"ls", "candidates", store_, "--where", "mean > 0", "--sort", "mean",
                            "--limit", "1", "--json"});
  const json list = json::parse(ran.out);
  ASSERT_EQ(list["rows"].size(), 1U);
  EXPECT_EQ(list["rows"][0]["candidate"], "c2");
  EXPECT_EQ(list["rows"][0]["mean"], 0.5);
  EXPECT_EQ(list["truncated"], true);
}

TEST_F(Ls, AndQueryTakeALimitOf0ForAll) {
  const std::string two = "SELECT 1 AS one UNION SELECT 2";
  EXPECT_THAT(run({"query", two, store_, "--limit", "1"}).err,
              HasSubstr("only the first row is shown"));
  EXPECT_THAT(run({"query", two + " UNION SELECT 3", store_, "--limit", "2"}).err,
              HasSubstr("only the first 2 rows are shown"));
  for (const std::string limit : {"0", "2"}) {
    const Ran ran = run_well({"query", two, store_, "--limit", limit, "--json"});
    EXPECT_EQ(json::parse(ran.out)["rows"].size(), 2U);
  }
  EXPECT_EQ(
      json::parse(run({"ls", "candidates", store_, "--limit", "0", "--json"}).out)["truncated"],
      false);
}

TEST_F(Ls, AndQueryFailsWhenItsTimeIsOverBeforeTheFirstRow) {
  const std::string endless =
      "WITH RECURSIVE t(x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM t) SELECT count(*) FROM t";
  for (const std::string form : {"--csv", "--json"}) {
    const Ran ran = run({"query", endless, store_, "--seconds", "1", form});
    EXPECT_EQ(ran.code, 1) << form;
    EXPECT_THAT(ran.err, HasSubstr("--seconds changes"));
  }
}

TEST_F(Ls, ExplainsAConditionThatIsNoSql) {
  EXPECT_THAT(refusal({"ls", "candidates", store_, "--where", "wombat > 1"}), HasSubstr("wombat"));
}

TEST_F(Ls, SuggestsTheKindThatWasMeant) {
  EXPECT_THAT(refusal({"ls", "candidate", store_}), HasSubstr("did you mean \"candidates\"?"));
}

TEST_F(Show, TellsOfDesignsCandidatesAndEvaluations) {
  const json design = json::parse(run({"show", "d1", store_, "--json"}).out);
  EXPECT_EQ(design["design"]["best_candidate"], "c1");
  EXPECT_EQ(design["test"][0]["mean"], 3.0);
  const json candidate = json::parse(run({"show", "c1", store_, "--json"}).out);
  EXPECT_EQ(candidate["candidate"]["fsm_config"], kExploreText);
  EXPECT_EQ(candidate["ancestry"][0]["candidate"], "c2");
  const json evaluation = json::parse(run({"show", "e100001t", store_, "--json"}).out);
  EXPECT_EQ(evaluation["evaluation"]["seed"], 99);
  EXPECT_EQ(json::parse(run({"show", "e100001", store_, "--json"}).out)["evaluation"]["seed"], 77);
  EXPECT_THAT(run({"show", "c1", store_}).out, HasSubstr("fsm_config     --nstates 1"));
}

TEST_F(Show, ExitsWithFourForWhatIsNotThereAndWithTwoForWhatIsNoId) {
  EXPECT_EQ(run({"show", "c99", store_}).code, 4);
  EXPECT_EQ(run({"show", "d99", store_}).code, 4);
  EXPECT_EQ(run({"show", "e99", store_}).code, 4);
  for (const char* wrong : {"x1", "c", "c1l", "d-1", "1"}) {
    EXPECT_EQ(run({"show", wrong, store_}).code, 2) << wrong;
  }
}

TEST_F(Query, ListsTheViewsWhenTheStatementIsMissing) {
  const Ran ran = run_well({"query", store_});
  EXPECT_THAT(ran.out, HasSubstr("v_leaderboard"));
  EXPECT_THAT(ran.out, HasSubstr("v_module_frequency"));
  EXPECT_THAT(ran.out, HasSubstr("occurrence_rate"));
}

TEST_F(Query, WritesTextCsvAndJson) {
  const std::string sql = "SELECT 1 AS a, 'x,\"y\"' AS b, NULL AS c, 0.1 AS d";
  EXPECT_EQ(run({"query", store_, sql}).out, "a  b      c    d\n1  x,\"y\"  -  0.1\n");
  EXPECT_EQ(run({"query", store_, sql, "--csv"}).out, "a,b,c,d\n1,\"x,\"\"y\"\"\",,0.1\n");
  EXPECT_EQ(json::parse(run({"query", store_, sql, "--json"}).out),
            json::parse(R"({"columns":["a","b","c","d"],"truncated":false,
                            "rows":[{"a":1,"b":"x,\"y\"","c":null,"d":0.1}]})"));
}

TEST_F(Query, TakesTheStoreFromAnOption) {
  EXPECT_EQ(run({"query", "--store", store_, "SELECT 7 AS n"}).out, "n\n7\n");
}

TEST_F(Query, OnlyReads) {
  EXPECT_THAT(refusal({"query", store_, "DELETE FROM candidate"}), HasSubstr("may only read"));
}

TEST_F(Export, WritesMachinesThatEvaluateReads) {
  const std::string file = (folder_ / "best.fsm").string();
  run_well({"export", store_, "-o", file});
  const Ran ran = run_well({"evaluate", file, "--json"});
  const std::string text = run({"export", store_}).out;
  EXPECT_THAT(text, StartsWith("# d1 aggregation watermelon repetition 1: c1, mean 2.5 over 1 "
                               "run\n#: format = 1\n#: flavour = \"watermelon\"\n"));
  EXPECT_THAT(text, EndsWith("--fsm-config --nstates 1 --s0 0 --rwm0 10\n"));
}

TEST_F(Export, WritesJsonWithParametersAndModules) {
  const json best = json::parse(run({"export", store_, "--format", "json"}).out)["machines"];
  ASSERT_EQ(best.size(), 1U);
  EXPECT_EQ(best[0]["candidate"], "c1");
  EXPECT_EQ(best[0]["parameters"]["RWM0"], 10);
  EXPECT_EQ(best[0]["modules"]["exploration"], 1);
  const auto all = json::parse(run({"export", store_, "--what", "all", "--json"}).out);
  EXPECT_EQ(all["machines"].size(), 2U);
}

TEST_F(Status, TellsOfCampaignAndDesigns) {
  EXPECT_THAT(run({"status", store_}).out, HasSubstr("campaign demo  finished  designs 1/1"));
  const json status = json::parse(run({"status", store_, "--json", "--watch"}).out);
  EXPECT_EQ(status["campaign"]["state"], "finished");
  EXPECT_EQ(status["designs"][0]["design"], "d1");
  EXPECT_EQ(status["failures"], 0);
}

TEST_F(Result, NamesTheWinnersWithTheirMachines) {
  std::ostringstream out;
  std::ostringstream err;
  Output output{.out = out, .err = err};
  const auto store = StoreReader::open(store_);
  EXPECT_EQ(write_result(output, **store), ExitCode::Done);
  EXPECT_THAT(out.str(), HasSubstr("best c1, mean score 2.5 in the race"));
  EXPECT_THAT(out.str(), HasSubstr("\n  " + kExploreText + "\n"));
  out.str("");
  output.json = true;
  write_result(output, **store);
  const json done = json::parse(out.str());
  EXPECT_EQ(done["event"], "done");
  EXPECT_EQ(done["designs"][0]["test_mean"], 3.0);
}

}  // namespace
}  // namespace swarmsmith::cli
