#include <map>
#include <string>

#include "coordinator/campaign/campaign_file.h"
#include "coordinator/campaign/campaign_rows.h"
#include "coordinator/design/plans.h"
#include "coordinator/design/rebuild.h"
#include "coordinator/design/verify.h"
#include "storage/internal/sqlite.h"
#include "storage/store.h"
#include "tests/coordinator/design/idle_pool.h"
#include "tests/support/checks.h"
#include "tests/support/one_design.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

using ::testing::Gt;

Campaign two_designs() {
  Campaign campaign = one_design_campaign();
  campaign.repetitions = 2;
  campaign.race.max_experiments = 1400;
  campaign.missions.front().test_count = 3;
  return campaign;
}

/// A campaign and its store, left and taken up again.
class StoredCampaign : public ::testing::Test {
 protected:
  /// `during(runner)` is called before the first of so many outcomes.
  template <class During>
  void go_on(const std::string& name, std::uint64_t seed, double looks, std::size_t limit,
             During during) {
    auto store =
        value_of(Store::open(folder_ / name, campaign_row(campaign_), design_rows(campaign_)));
    const auto commands = store->commands();
    const auto ended = ended_designs(store->design_states(), commands);
    CampaignRunner runner(*plans_of(campaign_), by_design(store->scores(), store->steps(), ended),
                          ended, commands);
    ASSERT_FALSE(runner.error()) << to_string(*runner.error());
    Memory memory;
    memory.rows.emplace_back(
        WorkerRow{.id = 1, .identity = "w", .host = "h", .state = WorkerState::Left});
    {
      IdlePool pool(runner, memory, Rng(seed), honest, looks);
      during(runner);
      pool.run(limit);
    }
    store->append(std::move(memory.rows));
  }
  void go_on(const std::string& name, std::uint64_t seed, double looks,
             std::size_t limit = ~std::size_t{0}) {
    go_on(name, seed, looks, limit, [](CampaignRunner&) {});
  }
  std::string digest(const std::string& name) {
    return (*StoreReader::open(folder_ / name))->digest();
  }
  std::vector<std::string> complaints(const std::string& name) {
    return verify(*value_of(StoreReader::open(folder_ / name)))->complaints;
  }
  std::vector<std::string> complaints_after(const std::string& name, const std::string& sql) {
    sqlite::Connection(folder_ / name, SQLITE_OPEN_READWRITE).execute(sql);
    return complaints(name);
  }
  void expect_clean(const std::string& name) { EXPECT_THAT(complaints(name), IsEmpty()); }

  Campaign campaign_ = two_designs();
  TemporaryFolder folder_;
};

CommandRow command(std::int64_t number, CommandKind kind, std::int64_t design,
                   std::int64_t budget = 0) {
  return {.number = number, .kind = kind, .design = {design}, .budget = budget, .who = "ann@lab"};
}

TEST_F(StoredCampaign, LookingAheadLeavesTheDigest) {
  go_on("plain", 1, 0);
  for (const std::size_t limit : {300U, 500U, 400U})
    go_on("ahead", limit, 0.3, limit);
  expect_clean("ahead");
  go_on("ahead", 2, 0.3);
  expect_clean("plain");
  expect_clean("ahead");
  EXPECT_EQ(digest("ahead"), digest("plain"));
  std::int64_t unused = 0;
  const auto reader = StoreReader::open(folder_ / "ahead");
  const auto counted = (*reader)->query(
      "SELECT count(*) FROM evaluation WHERE purpose = 0 AND iteration IS NULL", {}, [](auto&) {},
      [&](const auto& cells) { unused = std::stoll(cells.front().text); });
  ASSERT_TRUE(counted);
  EXPECT_THAT(unused, Gt(0)) << "something was computed in vain";
}

TEST_F(StoredCampaign, IsRebuiltFromItsScores) {
  go_on("s", 1, 0);
  const auto store =
      value_of(Store::open(folder_ / "s", campaign_row(campaign_), design_rows(campaign_)));
  std::vector<StoredScore> scores = store->scores();
  std::vector<StoredStep> steps = store->steps();
  const Rebuilt whole = rebuild(*plans_of(campaign_), scores, steps, {});
  EXPECT_THAT(whole.complaints, IsEmpty());
  ASSERT_EQ(whole.designs.size(), 2U);
  for (const Rebuilt::Design& design : whole.designs) {
    EXPECT_EQ(design.state, DesignState::Finished);
    EXPECT_GT(design.used, 1000);
    EXPECT_EQ(design.ahead, 0);
    EXPECT_EQ(design.unasked, 0);
    EXPECT_EQ(design.missing, 0U);
  }
  steps.front().digest += 1;
  EXPECT_THAT(rebuild(*plans_of(campaign_), scores, steps, {}).complaints,
              ElementsAre(HasSubstr("the scores give another step 1 than the stored one")));
  std::erase_if(scores, [](const StoredScore& score) {
    return score.key.candidate.value == 1 && score.key.pair == 1;
  });
  const Rebuilt lost = rebuild(*plans_of(campaign_), scores, {}, {});
  EXPECT_EQ(lost.designs[0].state, DesignState::Racing);
  EXPECT_GT(lost.designs[0].ahead, 0);
  EXPECT_EQ(lost.designs[0].missing, 1U);
}

TEST_F(StoredCampaign, WithoutAFileThatCanBeReadIsAnError) {
  go_on("s", 1, 0, 100);
  sqlite::Connection(folder_ / "s", SQLITE_OPEN_READWRITE)
      .execute("UPDATE campaign SET file = 'format = 0'");
  EXPECT_THAT(complaint_of(verify(*value_of(StoreReader::open(folder_ / "s")))),
              HasSubstr("the store's campaign file"));
}

TEST_F(StoredCampaign, CommandsAreReplayedAndVerified) {
  go_on("first", 1, 0.3, 700);
  go_on("first", 2, 0.3, 100, [](CampaignRunner& runner) {
    ASSERT_TRUE(runner.carry_out(command(1, CommandKind::Extend, 2, 1500)));
    ASSERT_TRUE(runner.carry_out(command(2, CommandKind::Cancel, 1)));
  });
  expect_clean("first");
  go_on("first", 3, 0.3, 1200);
  go_on("first", 4, 0.3);
  expect_clean("first");
  // From the start in another store, with the commands as they acted.
  {
    auto store = Store::open(folder_ / "again", campaign_row(campaign_), design_rows(campaign_));
    std::vector<Row> rows;
    for (CommandRow& row : (*StoreReader::open(folder_ / "first"))->commands()) {
      EXPECT_TRUE(row.step);
      if (row.kind == CommandKind::Extend) row.step.reset();  // it acts at the end anyway
      rows.emplace_back(row);
    }
    (*store)->append(std::move(rows));
  }
  go_on("again", 9, 0);
  expect_clean("again");
  EXPECT_EQ(digest("again"), digest("first"));
  std::vector<DesignState> states;
  for (const Row& row : (*StoreReader::open(folder_ / "first"))->answer_rows()) {
    if (const auto* state = std::get_if<DesignStateRow>(&row)) states.push_back(state->state);
  }
  EXPECT_THAT(states, ElementsAre(DesignState::Stopped, DesignState::Finished));
}

TEST_F(StoredCampaign, AFinishedStoreGoesOnWithMoreBudget) {
  go_on("first", 1, 0);
  const std::string before = digest("first");
  {
    auto store = Store::open(folder_ / "first", campaign_row(campaign_), design_rows(campaign_));
    EXPECT_TRUE((*store)->finished());
    EXPECT_FALSE(waits_for_extension((*store)->commands()));
    (*store)->append({command(1, CommandKind::Extend, 2, 1500)});
    (*store)->flush();
    EXPECT_TRUE(waits_for_extension((*store)->commands()));
  }
  EXPECT_EQ(digest("first"), before) << "nothing has come of it yet";
  expect_clean("first");
  go_on("first", 2, 0.3, 400);
  go_on("first", 3, 0.3);
  expect_clean("first");
  EXPECT_NE(digest("first"), before);
  auto store = Store::open(folder_ / "first", campaign_row(campaign_), design_rows(campaign_));
  EXPECT_TRUE((*store)->finished());
  EXPECT_GT((*store)->design_states().back().used, 2000);
}

/// A cancelled design is over, as a finished one is: its scores must give all that it has.
TEST_F(StoredCampaign, OfADesignThatIsOverAMissingScoreIsFound) {
  go_on("second", 1, 0.3);
  go_on("first", 1, 0, 300, [](CampaignRunner& runner) {
    ASSERT_TRUE(runner.carry_out(command(1, CommandKind::Cancel, 2)));
  });
  go_on("first", 2, 0, 600);
  go_on("first", 3, 0, 1, [](CampaignRunner& runner) {
    ASSERT_TRUE(runner.carry_out(command(2, CommandKind::Cancel, 1)));
  });
  for (const char* store : {"first", "second"}) {
    expect_clean(store);
    EXPECT_THAT(complaints_after(store,
                                 "DELETE FROM evaluation WHERE (candidate, purpose, pair) = (SELECT"
                                 " candidate, purpose, pair FROM evaluation WHERE purpose = 0 AND"
                                 " iteration > 0 LIMIT 1)"),
                Contains(HasSubstr("the design is finished, but 1 evaluation is missing")));
  }
}

TEST_F(StoredCampaign, SumsThatAreNotThoseOfTheScoresAreFound) {
  go_on("first", 1, 0.3);
  for (const char* sql : {"UPDATE candidate_totals SET score_sum = score_sum + 1 WHERE",
                          "DELETE FROM candidate_totals WHERE"})
    EXPECT_THAT(
        complaints_after("first", std::string(sql) +
                                      " candidate = (SELECT min(candidate) FROM candidate_totals)"),
        Contains(HasSubstr("the store's sums of")));
}

TEST_F(StoredCampaign, WrongSumsOfOneDesignHideNoneOfTheNext) {
  go_on("first", 1, 0.3);
  std::map<std::string, int> of_design;
  for (const std::string& what :
       complaints_after("first", "UPDATE candidate_totals SET score_sum = score_sum + 1")) {
    if (what.find("the store's sums of") != std::string::npos)
      ++of_design[what.substr(0, what.find(':'))];
  }
  EXPECT_GE(of_design.size(), 2U);
  for (const auto& [design, count] : of_design)
    EXPECT_EQ(count, 20) << design;
}

TEST_F(StoredCampaign, ACandidateAfterAGapIsFound) {
  go_on("first", 1, 0, 300);
  EXPECT_THAT(
      complaints_after("first",
                       "CREATE TEMP TABLE last AS SELECT * FROM candidate ORDER BY id DESC LIMIT 1;"
                       "UPDATE last SET id = id + 1; INSERT INTO candidate SELECT * FROM last"),
      Contains(HasSubstr("after a gap")));
}

}  // namespace
}  // namespace swarmsmith
