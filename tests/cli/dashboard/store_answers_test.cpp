#include "cli/dashboard/store_answers.h"

#include "tests/cli/dashboard/asking.h"
#include "tests/support/checks.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith::cli {
namespace {

using nlohmann::json;

using StoreAnswersTest = WithStore;

TEST_F(StoreAnswersTest, DesignsAreThoseOfTheCommandLine) {
  const Asking asking(store_);
  const json told = json::parse(run({"ls", "designs", store_, "--json"}).out)["rows"];
  const json answer = asking.json("c1/designs/d1");
  EXPECT_EQ(answer["v"], 1);
  EXPECT_EQ(answer["design"], told[0]);
  EXPECT_EQ(answer["machine"]["text"], kExploreText);
  EXPECT_EQ(answer["machine"]["candidate"], 1);
  EXPECT_EQ(answer["tests"]["n"], 1);
  EXPECT_EQ(answer["tests"]["mean"], 3);
  EXPECT_EQ(answer["elites"][0]["candidate"], 1);
  EXPECT_EQ(asking.error("c1/designs/d2"), "404 not_found");
  EXPECT_EQ(asking.error("c1/designs/three"), "400 bad_input");
  EXPECT_EQ(asking.error("c2/designs/d1"), "404 not_found");
  EXPECT_EQ(asking.error("c1/nothing"), "404 not_found");
}

TEST_F(StoreAnswersTest, CandidatesHaveTheirAncestorsAndScores) {
  const Asking asking(store_);
  const json told =
      json::parse(run({"ls", "candidates", store_, "--where", "candidate = 1", "--json"}).out);
  const json answer = asking.json("c1/candidates/c1");
  EXPECT_EQ(answer["candidate"], told["rows"][0]);
  EXPECT_EQ(answer["ancestors"].size(), 1U);
  EXPECT_EQ(answer["ancestors"][0]["fsm_config"], kStopText);
  EXPECT_EQ(answer["scores"]["id"][0], "e100001");
  EXPECT_EQ(answer["scores"]["seed"][0], 77);
  EXPECT_EQ(answer["later"][0]["purpose"], "test");
  EXPECT_EQ(answer["later"][0]["seed"], 99);
  EXPECT_EQ(asking.error("c1/candidates/c9"), "404 not_found");
  EXPECT_EQ(asking.error("c1/candidates/d1"), "400 bad_input");
}

TEST_F(StoreAnswersTest, AnEvaluationIsExplainedWithTheSameBytes) {
  const Asking asking(store_);
  EXPECT_EQ(asking.text("c1/evaluations/e100001"),
            run({"explain", "e100001", store_, "--json"}).out);
  EXPECT_EQ(asking.error("c1/evaluations/e100009"), "404 not_found");
}

TEST_F(StoreAnswersTest, FiguresAreThoseOfTheCommandLine) {
  const Asking asking(store_);
  EXPECT_EQ(asking.text("c1/figures/machine.svg", {{"design", "d1"}}),
            run({"figure", "machine", store_, "--design", "d1"}).out);
  const std::string file = (folder_ / "box.csv").string();
  run_well({"figure", "box", store_, "-o", file});
  EXPECT_EQ(asking.text("c1/figures/box.csv"), whole_file(file));
  EXPECT_EQ(asking.error("c1/figures/pie.svg"), "404 not_found");
  EXPECT_EQ(asking.error("c1/figures/box.pdf"), "404 not_found");
  EXPECT_EQ(asking.error("c1/figures/box.svg", {{"candidate", "c1"}}), "400 bad_input");
  EXPECT_EQ(asking.error("c1/figures/box.svg", {{"mission", "nowhere"}}), "400 bad_input");
  EXPECT_EQ(asking.error("c1/figures/box.svg", {{"width", "3m"}}), "400 bad_input");
  EXPECT_EQ(asking.error("c1/figures/machine.svg", {{"candidate", "c77"}}), "404 not_found");
}

TEST_F(StoreAnswersTest, WhatHasNothingToShowYetIsAnAnswerThatSaysSo) {
  const Asking asking(store_);
  for (const char* path : {"c1/figures/ranks.svg", "c1/figures/gap.csv", "c1/comparison/pairs.csv"})
    EXPECT_FALSE(asking.json(path)["nothing"].get<std::string>().empty()) << path;
}

TEST_F(StoreAnswersTest, ComparisonsAreThoseOfTheCommandLine) {
  const Asking asking(store_);
  EXPECT_EQ(asking.text("c1/comparison/groups.csv", {{"by", "method"}}),
            run({"compare", store_, "--by", "method", "--csv", "--table", "groups"}).out);
  EXPECT_EQ(asking.error("c1/comparison/pairs.pdf"), "404 not_found");
  EXPECT_EQ(asking.error("c1/comparison/pairs.csv", {{"by", "luck"}}), "400 bad_input");
}

TEST_F(StoreAnswersTest, ColumnsAreTheViews) {
  const Asking asking(store_);
  const std::vector<std::pair<std::string, std::string>> views = {
      {"scores", "v_design_scores"},
      {"leaderboard", "v_leaderboard"},
      {"modules", "v_module_frequency"}};
  for (const auto& [path, view] : views) {
    const json columns = asking.json("c1/" + path);
    const json rows =
        json::parse(run({"query", store_, "SELECT * FROM " + view, "--json"}).out)["rows"];
    ASSERT_FALSE(rows.empty()) << path;
    for (const auto& [name, value] : rows[0].items())
      EXPECT_EQ(columns[name][0], value) << path << " " << name;
  }
  EXPECT_EQ(asking.json("c1/real-runs")["id"].size(), 0U);
  EXPECT_EQ(asking.json("c1/scores", {{"design", "d9"}})["score"].size(), 0U);
}

TEST_F(StoreAnswersTest, ViewsAreExplained) {
  const json views = Asking(store_).json("c1/views")["views"];
  bool found = false;
  for (const json& view : views) {
    EXPECT_FALSE(view["columns"].empty()) << view["name"];
    if (view["name"] != "v_designs") continue;
    found = true;
    EXPECT_EQ(view["text"], "a design, that is one race");
    for (const json& column : view["columns"])
      EXPECT_NE(column["text"], "") << column["name"];
  }
  EXPECT_TRUE(found);
}

TEST_F(StoreAnswersTest, StatementsAnswerAsTheCommandLine) {
  const Asking asking(store_);
  const std::string sql = "SELECT candidate, mean FROM v_candidates ORDER BY candidate";
  const json answer = asking.json("c1/query", {{"sql", sql}});
  EXPECT_THAT(answer["columns"], ElementsAre("candidate", "mean"));
  EXPECT_EQ(answer["rows"], json::parse("[[1,2.5],[2,0.5]]"));
  EXPECT_EQ(answer["truncated"], false);
  EXPECT_TRUE(answer["seconds"].is_number());
  EXPECT_EQ(asking.text("c1/query", {{"sql", sql}, {"format", "csv"}}),
            run({"query", store_, sql, "--csv"}).out);
  EXPECT_EQ(asking.json("c1/query", {{"sql", sql}, {"limit", "1"}})["truncated"], true);
  EXPECT_EQ(asking.json("c1/query", {{"sql", "-- one\nSELECT 1"}})["rows"], json::parse("[[1]]"));
  // Columns of one name are two.
  EXPECT_EQ(asking.json("c1/query", {{"sql", "SELECT 1 AS a, 2 AS a"}})["rows"],
            json::parse("[[1,2]]"));
}

TEST_F(StoreAnswersTest, StatementsMayOnlyRead) {
  const Asking asking(store_);
  for (const char* sql : {"DELETE FROM candidate", "ATTACH 'x.db' AS x", "SELECT 1; SELECT 2",
                          "PRAGMA user_version = 3", "SELECT load_extension('x')", "", "nonsense",
                          "SELECT length(hex(zeroblob(300000000)))"})
    EXPECT_EQ(asking.error("c1/query", {{"sql", sql}}), "400 bad_input") << sql;
  const SiteAnswer refused = asking.answer("c1/query", {{"sql", "DELETE FROM candidate"}});
  EXPECT_THAT(refused.body, HasSubstr("a query may only read"));
}

TEST_F(StoreAnswersTest, ALongAnswerIsRefusedAndManyRowsAreCut) {
  const Asking asking(store_);
  const std::string endless =
      "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT i FROM n";
  const json cut = asking.json("c1/query", {{"sql", endless}});
  EXPECT_EQ(cut["rows"].size(), 10'000U);
  EXPECT_EQ(cut["truncated"], true);
  EXPECT_EQ(asking.error("c1/query", {{"sql", endless}, {"limit", "10001"}}), "400 bad_input");
  const SiteAnswer refused = asking.answer(
      "c1/query", {{"sql",
                    "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT "
                    "hex(zeroblob(5000)) FROM n LIMIT 1000"}});
  EXPECT_EQ(refused.status, 400);
  EXPECT_THAT(refused.body, HasSubstr("longer than 8 MB"));
}

TEST_F(StoreAnswersTest, AStatementEndsWhenWhoAskedGoesAway) {
  const Asking asking(store_);
  SiteRequest request{.path = "/api/v1/c1/query"};
  request.parameters["sql"] =
      "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT count(*) FROM n";
  request.is_gone = [] { return true; };
  EXPECT_EQ(asking.site->answer(request).status, 503);
}

TEST_F(StoreAnswersTest, EventsComeFromAllViewsNewestFirst) {
  {
    const auto reader = StoreReader::open(store_).value();
    const auto store = Store::open(store_, reader->campaign(), reader->designs()).value();
    store->append({event_row("warning", "worker lost", {{"host", std::string("<img src=x>")}})});
    store->append({CommandRow{.number = 1,
                              .kind = CommandKind::Pause,
                              .design = DesignId{1},
                              .step = std::nullopt,
                              .budget = 0,
                              .who = "anna@lab"}});
    store->flush();
  }
  const Asking asking(store_);
  const json answer = asking.json("c1/events");
  ASSERT_GE(answer["events"].size(), 2U);
  std::string before = "9";
  std::map<std::string, json> by_kind;
  for (const json& event : answer["events"]) {
    EXPECT_LE(event["at"].get<std::string>(), before);
    before = event["at"];
    by_kind[event["kind"]] = event;
  }
  EXPECT_EQ(by_kind["worker lost"]["data"]["host"], "<img src=x>");
  EXPECT_EQ(by_kind["worker lost"]["seq"], answer["last"]);
  EXPECT_EQ(by_kind["command"]["data"]["who"], "anna@lab");
  EXPECT_EQ(by_kind["command"]["data"]["command"], "pause");
  EXPECT_TRUE(by_kind["command"]["seq"].is_null());
  const json later = asking.json("c1/events", {{"after", answer["last"].dump()}});
  for (const json& event : later["events"])
    EXPECT_TRUE(event["seq"].is_null());
}

TEST_F(StoreAnswersTest, ParametersOfAddressesAreChecked) {
  const Asking asking(store_);
  EXPECT_EQ(asking.error("c1/events", {{"limit", "0"}}), "400 bad_input");
  EXPECT_EQ(asking.error("c1/events", {{"after", "x"}}), "400 bad_input");
  EXPECT_EQ(asking.error("c1/convergence", {{"design", "3"}}), "400 bad_input");
  EXPECT_EQ(asking.error("c1/designs/d1/steps", {{"after", "-1"}}), "400 bad_input");
}

}  // namespace
}  // namespace swarmsmith::cli
