#include "cli/dashboard/race_answers.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <map>
#include <string>
#include <utility>

#include "storage/internal/sqlite.h"
#include "tests/cli/dashboard/asking.h"

namespace swarmsmith::cli {
namespace {

using nlohmann::json;

class RaceAnswersTest : public testing::Test {
 protected:
  void SetUp() override { write_synthetic_store(store_); }

  json query(const std::string& sql) const {
    return json::parse(run({"query", store_, sql, "--json", "--lists"}).out)["rows"];
  }

  TemporaryFolder folder_;
  std::string store_ = (folder_ / "races.db").string();
};

TEST_F(RaceAnswersTest, ARaceHasAllCellsOfItsView) {
  const json race = Asking(store_).json("c1/designs/d1/race", {{"iteration", "2"}});
  std::map<std::pair<std::int64_t, std::int64_t>, json> expected;
  for (const json& row : query("SELECT step, candidate, score, rank FROM v_race_matrix WHERE "
                               "design = 1 AND iteration = 2"))
    expected[{row[0], row[1]}] = {row[2], row[3]};
  ASSERT_GT(expected.size(), 20U);
  std::map<std::pair<std::int64_t, std::int64_t>, json> found;
  for (std::size_t s = 0; s < race["steps"].size(); ++s) {
    for (std::size_t i = 0; i < race["scores"][s].size(); ++i)
      found[{race["steps"][s], race["candidates"][i]}] = {race["scores"][s][i],
                                                          race["ranks"][s][i]};
    EXPECT_EQ(race["ranked"][s], race["scores"][s].size());
  }
  EXPECT_EQ(found, expected);
  EXPECT_EQ(race["rows_total"], race["candidates"].size());
  EXPECT_EQ(race["ended"], true);
}

TEST_F(RaceAnswersTest, AnotherStoreOfTheSameNameHasItsOwnAnswers) {
  const Asking asking(store_);
  const std::map<std::string, std::string> first{{"iteration", "1"}};
  const json before = asking.json("c1/designs/d1/race", first);
  EXPECT_EQ(before["ended"], true) << "it is kept for ever";
  const std::string other = (folder_ / "other.db").string();
  write_synthetic_store(other, {.candidates = 6});
  std::filesystem::rename(other, store_);
  const json after = asking.json("c1/designs/d1/race", first);
  EXPECT_NE(after["candidates"], before["candidates"]);
  EXPECT_EQ(after, Asking(store_).json("c1/designs/d1/race", first));
}

TEST_F(RaceAnswersTest, WhoWasDroppedHasNoFurtherScores) {
  const json race = Asking(store_).json("c1/designs/d1/race", {{"iteration", "1"}});
  std::size_t before = race["candidates"].size();
  bool any_dropped = false;
  for (std::size_t s = 0; s < race["steps"].size(); ++s) {
    EXPECT_LE(race["scores"][s].size(), before);
    before = race["scores"][s].size();
    std::size_t left = 0;
    for (std::size_t i = 0; i < race["candidates"].size(); ++i) {
      const json& dropped = race["dropped_at"][i];
      any_dropped = any_dropped || !dropped.is_null();
      if (dropped.is_null() || dropped.get<int>() > race["steps"][s].get<int>()) ++left;
      EXPECT_EQ(dropped.is_null(), race["reasons"][i].is_null());
    }
    // At the end of the race all but the elites go, too.
    if (s + 1 < race["steps"].size()) {
      EXPECT_EQ(left, race["alive"][s].get<std::size_t>());
    }
  }
  EXPECT_TRUE(any_dropped);
}

TEST_F(RaceAnswersTest, PairsElitesAndStepsAreThoseOfTheViews) {
  const json race = Asking(store_).json("c1/designs/d2/race", {{"iteration", "3"}});
  const json steps = query(
      "SELECT step, pair, marker, alive_after, used FROM v_race_steps WHERE "
      "design = 2 AND iteration = 3 ORDER BY step");
  ASSERT_EQ(race["steps"].size(), steps.size());
  for (std::size_t s = 0; s < steps.size(); ++s)
    EXPECT_EQ(json::array({race["steps"][s], race["pairs"][s], race["markers"][s], race["alive"][s],
                           race["used"][s]}),
              steps[s]);
  for (std::size_t s = 0; s < steps.size(); ++s)
    EXPECT_EQ(race["meanings"][s] == "no test", race["markers"][s] == "x") << s;
  for (const json& row : query("SELECT DISTINCT pair, instance, seed FROM v_race_matrix WHERE "
                               "design = 2 AND iteration = 3")) {
    for (std::size_t s = 0; s < steps.size(); ++s) {
      if (race["pairs"][s] != row[0]) continue;
      EXPECT_EQ(race["instances"][s], row[1]);
      EXPECT_EQ(race["seeds"][s], row[2]);
    }
  }
  for (const auto& [field, iteration] : {std::pair("elite_before", 2), {"elite_after", 3}}) {
    json ranks = json::object();
    for (std::size_t i = 0; i < race["candidates"].size(); ++i)
      if (!race[field][i].is_null()) ranks[race["candidates"][i].dump()] = race[field][i];
    json expected = json::object();
    for (const json& row : query("SELECT candidate, rank FROM v_convergence WHERE design = 2 AND "
                                 "iteration = " +
                                 std::to_string(iteration)))
      expected[row[0].dump()] = row[1];
    EXPECT_EQ(ranks, expected) << field;
  }
}

TEST_F(RaceAnswersTest, APartOfTheRowsIsThatPart) {
  const Asking asking(store_);
  const json all = asking.json("c1/designs/d1/race", {{"iteration", "2"}});
  const json part =
      asking.json("c1/designs/d1/race", {{"iteration", "2"}, {"rows", "3"}, {"from", "1"}});
  EXPECT_EQ(part["rows_total"], all["rows_total"]);
  ASSERT_EQ(part["candidates"].size(), 3U);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(part["candidates"][i], all["candidates"][i + 1]);
  EXPECT_EQ(part["scores"][0][0], all["scores"][0][1]);
  // Ranks are those among all, not among the rows of this answer.
  EXPECT_EQ(part["ranks"][0][0], all["ranks"][0][1]);
  EXPECT_EQ(part["ranked"], all["ranked"]);
  EXPECT_EQ(asking.json("c1/designs/d1/race", {{"iteration", "2"}, {"from", "9999"}})["candidates"]
                .size(),
            0U);
}

TEST_F(RaceAnswersTest, TheLastIterationIsTheUsualOne) {
  const Asking asking(store_);
  EXPECT_EQ(asking.json("c1/designs/d1/race")["iteration"], 3);
  EXPECT_EQ(asking.error("c1/designs/d1/race", {{"iteration", "4"}}), "404 not_found");
  EXPECT_EQ(asking.error("c1/designs/d1/race", {{"iteration", "0"}}), "400 bad_input");
  EXPECT_EQ(asking.error("c1/designs/d8/race"), "404 not_found");
}

TEST_F(RaceAnswersTest, UntilItsFirstStepARaceIsNotShown) {
  const auto change = [&](const std::string& sql) {
    sqlite::Connection(store_, SQLITE_OPEN_READWRITE).execute(sql);
  };
  change("DELETE FROM race_step WHERE design = 1 AND iteration = 3");
  EXPECT_EQ(Asking(store_).json("c1/designs/d1/race")["iteration"], 2);
  EXPECT_EQ(Asking(store_).json("c1/designs/d1/race", {{"iteration", "3"}})["steps"].size(), 0U);
  change("PRAGMA foreign_keys = OFF; DELETE FROM iteration WHERE design = 1");
  EXPECT_FALSE(Asking(store_).json("c1/designs/d1/race")["nothing"].get<std::string>().empty());
}

TEST_F(RaceAnswersTest, StepsAreThoseAfterTheOneNamed) {
  const Asking asking(store_);
  const json all = asking.json("c1/designs/d1/steps");
  const json later = asking.json("c1/designs/d1/steps", {{"after", "5"}});
  EXPECT_EQ(later["step"][0], 6);
  EXPECT_EQ(later["step"].size() + 5, all["step"].size());
  EXPECT_EQ(all["marker"].size(), all["step"].size());
}

TEST_F(RaceAnswersTest, ParametersAreThoseOfTheCandidates) {
  const Asking asking(store_);
  const json all = asking.json("c1/designs/d1/parameters");
  EXPECT_EQ(all["total"], all["candidates"].size());
  std::map<std::int64_t, std::size_t> places;
  for (std::size_t i = 0; i < all["candidates"].size(); ++i)
    places[all["candidates"][i]] = i;
  std::size_t compared = 0;
  for (const json& row :
       query("SELECT candidate, parameter, value FROM v_parameters WHERE design = 1")) {
    EXPECT_EQ(all["parameters"][row[1].get<std::string>()][places.at(row[0])], row[2]);
    ++compared;
  }
  EXPECT_GT(compared, 10U);
  const json sample = asking.json("c1/designs/d1/parameters", {{"sample", "2"}});
  EXPECT_EQ(sample["total"], all["total"]);
  EXPECT_LT(sample["candidates"].size(), all["candidates"].size());
  for (const json& elite : query("SELECT DISTINCT candidate FROM v_convergence WHERE design = 1"))
    EXPECT_TRUE(std::ranges::count(sample["candidates"], elite[0]) == 1);
  const std::string name = all["parameters"].begin().key();
  EXPECT_EQ(asking.json("c1/designs/d1/parameters", {{"names", name}})["parameters"].size(), 1U);
}

TEST_F(RaceAnswersTest, ConvergenceOfADesignHasAllItsElites) {
  const Asking asking(store_);
  const json one = asking.json("c1/convergence", {{"design", "d1"}});
  EXPECT_EQ(one["mean"].size(), query("SELECT 1 FROM v_convergence WHERE design = 1").size());
  const json best = asking.json("c1/convergence");
  for (const json& rank : best["rank"])
    EXPECT_EQ(rank, 1);
}

}  // namespace
}  // namespace swarmsmith::cli
