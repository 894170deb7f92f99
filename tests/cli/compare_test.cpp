#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/cli/cli_support.h"
#include "tests/storage/fixture.h"
#include "tests/support/checks.h"

namespace swarmsmith::cli {
namespace {

using nlohmann::json;

/// Twelve designs of one mission, six of each of two methods. Each winner got 1 in reality.
struct Compare : testing::Test {
  TemporaryFolder folder;
  std::string store_ = (folder / "s.db").string();

  Compare() {
    SyntheticCampaign campaign = synthetic_campaign({.designs = 12, .tests = 4});
    for (DesignRow& design : campaign.designs) {
      design.mission = "aggregation";
      design.method = design.id.value % 2 == 1 ? "chocolate" : "watermelon";
    }
    auto store = open_store(store_, campaign);
    for (const auto& batch : campaign.batches) {
      store->append(batch);
      for (const Row& row : batch) {
        const auto* end = std::get_if<DesignStateRow>(&row);
        if (end != nullptr && end->state == DesignState::Finished) store->append(real_run(*end));
      }
    }
  }

  static std::vector<Row> real_run(const DesignStateRow& design) {
    return {
        PairRow{.design = design.design,
                .purpose = Purpose::Score,
                .number = 1,
                .instance = 1,
                .seed = 1},
        EvaluationRow{
            .key = {design.best, Purpose::Score, 1}, .measured = {.score = 1}, .source = "real"}};
  }
};

TEST_F(Compare, BySourceIsTheDefault) {
  const Ran ran = run_well({"compare", store_});
  EXPECT_THAT(ran.out, HasSubstr("aggregation  chocolate   rvr    real    6"));
  EXPECT_THAT(ran.out, HasSubstr("aggregation  watermelon  rvr    real    6"));
  EXPECT_THAT(ran.out, HasSubstr("Wilcoxon signed-rank test, two-sided"));
  EXPECT_THAT(ran.out, HasSubstr("Ranks of mean scores over aggregation (12 blocks)"));
}

TEST_F(Compare, ByMethodIsWithinASource) {
  const Ran ran = run_well({"compare", store_, "--by", "method"});
  EXPECT_THAT(ran.out, HasSubstr("aggregation  rvr     chocolate  watermelon  6+6"));
  EXPECT_THAT(ran.out, HasSubstr("aggregation  real    chocolate  watermelon  6+6"));
}

TEST_F(Compare, WithOneSourceComparesTheMethods) {
  SyntheticCampaign campaign = synthetic_campaign({.designs = 6, .tests = 4});
  for (DesignRow& design : campaign.designs) {
    design.mission = "aggregation";
    design.method = design.id.value % 2 == 1 ? "chocolate" : "watermelon";
  }
  const std::string alone = (folder / "one.db").string();
  fill_store(alone, campaign);
  EXPECT_EQ(run({"compare", alone}).out, run({"compare", alone, "--by", "method"}).out);
  EXPECT_THAT(run({"compare", alone}).out, HasSubstr("chocolate  watermelon  3+3"));
}

TEST_F(Compare, AMatrixSaysWhichMethodWinsWhere) {
  const Ran text = run_well({"compare", store_, "--matrix"});
  EXPECT_THAT(text.out, HasSubstr("\nrvr\nmethod"));
  EXPECT_THAT(text.out, HasSubstr("do\nnot differ at 5 %"));
  const json answer = json::parse(run({"compare", store_, "--matrix", "--json"}).out);
  ASSERT_EQ(answer["matrices"].size(), 2U);
  EXPECT_EQ(answer["matrices"][1]["source"], "real");
  const json& best = answer["matrices"][0]["methods"][0];
  EXPECT_EQ(best["mean_rank"], 1);
  EXPECT_EQ(best["cells"][0]["n"], 6);
  EXPECT_EQ(best["cells"][0]["behind"], 0);
  EXPECT_THAT(run({"compare", store_, "--csv", "--table", "matrix"}).out,
              StartsWith("source,mission,method,n,runs,mean,low,high,rank,"));
  EXPECT_EQ(run({"compare", store_, "--matrix", "--by", "source"}).code, 2);
  EXPECT_EQ(run({"compare", store_, "--matrix", "--csv"}).code, 2);
}

TEST_F(Compare, WritesJson) {
  const Ran ran = run_well({"compare", store_, "--by", "method", "--source", "rvr", "--json"});
  const json answer = json::parse(ran.out);
  EXPECT_EQ(answer["by"], "method");
  EXPECT_EQ(answer["groups"].size(), 2U);
  ASSERT_EQ(answer["pairs"].size(), 1U);
  const json& pair = answer["pairs"][0];
  EXPECT_EQ(pair["test"], "rank-sum");
  EXPECT_EQ(pair["n_first"], 6);
  EXPECT_EQ(pair["p"], pair["p_holm"]);
  EXPECT_DOUBLE_EQ(
      pair["mean_difference"].get<double>(),
      answer["groups"][0]["mean"].get<double>() - answer["groups"][1]["mean"].get<double>());
  // Of one mission there are none by method.
  EXPECT_EQ(answer["ranks"], json::array());
  const json by_source = json::parse(run({"compare", store_, "--json"}).out);
  EXPECT_EQ(by_source["ranks"][0]["names"], json({"rvr", "real"}));
  EXPECT_EQ(answer["bootstrap"]["seed"], 1);
}

TEST_F(Compare, JsonHasNullWhereThereIsNoP) {
  const json answer =
      json::parse(run({"compare", store_, "--by", "method", "--source", "real", "--json"}).out);
  EXPECT_TRUE(answer["pairs"][0]["p"].is_null());
  EXPECT_EQ(answer["pairs"][0]["notes"][0], "all values are the same: no p");
}

TEST_F(Compare, WritesATableAsCsv) {
  EXPECT_THAT(run({"compare", store_, "--csv"}).out,
              StartsWith("mission,method,source,first,second,n_first,"));
  EXPECT_THAT(run({"compare", store_, "--csv", "--table", "ranks"}).out,
              StartsWith("source,name,mean_rank,"));
  EXPECT_THAT(run({"compare", store_, "--csv", "--by", "mission"}).out,
              StartsWith("mission,method,source,n,designs,"));
}

TEST_F(Compare, PurposeAndUnitSayWhatAValueIs) {
  const auto runs_of = [&](const std::string& purpose) {
    const Ran ran = run({"compare", store_, "--by", "mission", "--purpose", purpose, "--json"});
    const json answer = json::parse(ran.out);
    int runs = 0;
    for (const json& group : answer["groups"])
      runs += group["runs"].get<int>();
    return runs;
  };
  EXPECT_EQ(runs_of("test"), 48);
  EXPECT_EQ(runs_of("score"), 12);
  EXPECT_EQ(runs_of("all"), 60);
  const json by_run =
      json::parse(run({"compare", store_, "--by", "method", "--per", "run", "--json"}).out);
  EXPECT_EQ(by_run["pairs"][0]["n_first"], 24);
  EXPECT_THAT(by_run["notes"].dump(), HasSubstr("not independent"));
}

TEST_F(Compare, WhatIsNotThereExitsWithFour) {
  const Ran ran = run({"compare", store_, "--mission", "nowhere"});
  EXPECT_EQ(ran.code, 4);
  EXPECT_THAT(ran.err, HasSubstr("no scores of mission `nowhere`; there are aggregation"));
  EXPECT_EQ(run({"compare", store_, "--table", "ranks"}).code, 2);
  EXPECT_THAT(refusal({"compare", store_, "--csv", "--table", "matrix", "--by", "mission"}),
              HasSubstr("leave --by out"));
  EXPECT_EQ(run({"compare", store_ + ".gone"}).code, 3);
}

}  // namespace
}  // namespace swarmsmith::cli
