#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "storage/store_at_rest.h"
#include "tests/storage/fixture.h"
#include "tests/support/checks.h"
#include "tests/support/not_empty.h"

namespace swarmsmith {
namespace {

using Cells = std::vector<std::string>;
using IfMissing = StoreAtRest::IfMissing;

/// A finished design with its winner, and a score of it.
Addition imported(std::int64_t design, double score) {
  const CandidateId winner = candidate_id({design}, 1);
  return {
      .campaign =
          CampaignRow{
              .name = "from elsewhere", .digest = "x", .deciding = "{}", .file = "", .seed = 0},
      .designs = {{.row = {.id = {design},
                           .mission = "m",
                           .method = "by hand",
                           .flavour = "watermelon",
                           .repetition = 1},
                   .name = "hA1"}},
      .removed = {},
      .rows = {
          CandidateRow{.id = winner,
                       .parameters = "{}",
                       .machine = "--nstates 1",
                       .modules = R"({"stop":1})",
                       .states = 1},
          DesignStateRow{.design = {design},
                         .state = DesignState::Finished,
                         .best = winner,
                         .reason = "imported"},
          PairRow{
              .design = {design}, .purpose = Purpose::Score, .number = 1, .instance = 1, .seed = 5},
          EvaluationRow{
              .key = {winner, Purpose::Score, 1}, .measured = {.score = score}, .source = "real"}}};
}

struct AtRestTest : testing::Test {
  TemporaryFolder folder_;
  std::filesystem::path path_ = folder_ / "s.db";

  std::vector<Cells> all(const std::string& sql) { return cells_of(*open_reader(path_), sql); }
};

TEST_F(AtRestTest, MakesAStoreOfItsOwnWithoutACampaignFile) {
  {
    auto store = value_of(StoreAtRest::open(path_, IfMissing::Make));
    EXPECT_TRUE(store->is_new());
    const auto added = store->add(imported(1, 2.5));
    ASSERT_TRUE(added) << to_string(added.error());
    EXPECT_FALSE(store->is_new());
  }
  EXPECT_THAT(all("SELECT name, state FROM v_campaign_status"),
              ElementsAre(Cells{"from elsewhere", "imported"}));
  // No race was held: there is no mean of one.
  EXPECT_THAT(all("SELECT design, name, state, best_candidate, best_mean, flavour FROM v_designs"),
              ElementsAre(Cells{"1", "hA1", "finished", "1", "NULL", "watermelon"}));
  EXPECT_THAT(all("SELECT candidate, source, purpose, seed, score FROM v_design_scores"),
              ElementsAre(Cells{"1", "real", "score", "5", "2.5"}));
}

TEST_F(AtRestTest, LeavesNoFileWhereNothingWasAdded) {
  { ASSERT_TRUE(StoreAtRest::open(path_, IfMissing::Make)); }
  EXPECT_FALSE(std::filesystem::exists(path_));
  EXPECT_EQ(why_not(StoreAtRest::open(path_, IfMissing::Refuse)).kind, ErrorKind::NotFound);
}

TEST_F(AtRestTest, TakesAllOfAnAdditionOrNothing) {
  auto store = value_of(StoreAtRest::open(path_, IfMissing::Make));
  ASSERT_TRUE(store->add(imported(1, 1)));
  Addition second = imported(3, 1);  // design 2 is not there
  EXPECT_EQ(why_not(store->add(second)).kind, ErrorKind::Conflict);
  second = imported(2, 1);
  // A row that no store takes: a design that is not there.
  second.rows.emplace_back(
      EvaluationRow{.key = {candidate_id({7}, 1), Purpose::Score, 1}, .source = "real"});
  EXPECT_FALSE(store->add(second));
  EXPECT_THAT(all("SELECT count(*) FROM v_designs"), ElementsAre(Cells{"1"}));
  EXPECT_THROW(static_cast<void>(store->add(imported(2, std::nan("")))), std::invalid_argument);
}

TEST_F(AtRestTest, TakesNoTextThatItsReadersWouldRefuse) {
  const std::string longest(kLongestName, 'x');
  const std::vector<std::pair<std::string, std::function<void(Addition&)>>> changes{
      {"a name in the store's table campaign", [&](Addition& a) { a.campaign->name += longest; }},
      {"a name in the store's table source",
       [&](Addition& a) { std::get<EvaluationRow>(a.rows.back()).source += longest; }},
      {"a mission in the store's table design",
       [&](Addition& a) { a.designs[0].row.mission += longest; }},
      {"a method in the store's table design",
       [&](Addition& a) { a.designs[0].row.method += longest; }},
      {"a flavour in the store's table design",
       [&](Addition& a) { a.designs[0].row.flavour += longest; }},
      {"a name in the store's table design", [&](Addition& a) { a.designs[0].name += longest; }},
      {"a reason in the store's table design",
       [&](Addition& a) { std::get<DesignStateRow>(a.rows[1]).reason.resize((1 << 20) + 1, 'x'); }},
      {"a parameters in the store's table phrase",
       [&](Addition& a) {
         std::get<CandidateRow>(a.rows[0]).parameters =
             R"({"x":")" + std::string(9 << 20, 'x') + "\"}";
       }},
  };
  for (const auto& [text, change] : not_empty(changes)) {
    SCOPED_TRACE(text);
    Addition addition = imported(1, 1);
    change(addition);
    auto store = value_of(StoreAtRest::open(path_, IfMissing::Make));
    const Error refused = why_not(store->add(addition));
    EXPECT_EQ(refused.kind, ErrorKind::BadInput);
    EXPECT_THAT(refused.message, AllOf(HasSubstr(text), HasSubstr("nothing was added")));
    addition = imported(1, 1);
    addition.campaign->name = longest;
    std::get<EvaluationRow>(addition.rows.back()).source = longest;
    ASSERT_TRUE(store->add(addition));
    change(addition = imported(2, 1));
    EXPECT_EQ(why_not(store->add(addition)).kind, ErrorKind::BadInput);
    EXPECT_THAT(all("SELECT source FROM v_design_scores"), ElementsAre(Cells{longest}));
    store.reset();
    EXPECT_TRUE(StoreAtRest::open(path_, IfMissing::Refuse));
    std::filesystem::remove(path_);
  }
}

TEST_F(AtRestTest, KeepsWhatIsThereUntilItIsRemoved) {
  auto store = value_of(StoreAtRest::open(path_, IfMissing::Make));
  ASSERT_TRUE(store->add(imported(1, 1)));
  const EvaluationRow other{
      .key = {candidate_id({1}, 1), Purpose::Score, 1}, .measured = {.score = 9}, .source = "real"};
  ASSERT_TRUE(store->add({.campaign = {}, .designs = {}, .removed = {}, .rows = {other}}));
  EXPECT_THAT(all("SELECT score FROM v_design_scores"), ElementsAre(Cells{"1"}));
  ASSERT_TRUE(store->add({.campaign = {}, .designs = {}, .removed = {other.key}, .rows = {other}}));
  EXPECT_THAT(all("SELECT score FROM v_design_scores"), ElementsAre(Cells{"9"}));
}

TEST_F(AtRestTest, KeepsTheTextOfEachProfileOnce) {
  using Profiles = std::map<std::string, std::string>;
  auto store = value_of(StoreAtRest::open(path_, IfMissing::Make));
  Addition addition = imported(1, 1);
  addition.profiles = {{"gentle", "noise = 1"}, {"", "of no name"}};
  ASSERT_TRUE(store->add(addition));
  ASSERT_TRUE(store->add({.profiles = {{"gentle", "noise = 1"}, {"rough", "noise = 2"}}}));
  EXPECT_EQ(why_not(store->add({.profiles = {{"gentle", "noise = 3"}}})).kind, ErrorKind::Conflict);
  EXPECT_EQ(open_reader(path_)->kept_profiles(),
            (Profiles{{"", "of no name"}, {"gentle", "noise = 1"}, {"rough", "noise = 2"}}));
}

TEST_F(AtRestTest, StaysOutWhileACampaignWrites) {
  const SyntheticCampaign made = synthetic_campaign({.designs = 2, .iterations = 1});
  const auto campaign = Store::open(path_, made.campaign, made.designs);
  ASSERT_TRUE(campaign);
  const Error refused = why_not(StoreAtRest::open(path_, IfMissing::Refuse));
  EXPECT_EQ(refused.kind, ErrorKind::Conflict);
  EXPECT_THAT(refused.message, HasSubstr("pid"));
}

TEST_F(AtRestTest, TellsTheFlavoursOfAnOldStoresDesigns) {
  std::filesystem::copy_file(std::string(SWARMSMITH_TEST_DATA) + "/stores/schema-3.sqlite", path_);
  {
    ASSERT_TRUE(StoreAtRest::open(path_, IfMissing::Refuse, {{.id = {1}, .flavour = "chocolate"}}));
  }
  EXPECT_THAT(all("SELECT design, flavour FROM v_designs"), ElementsAre(Cells{"1", "chocolate"}));
  for (const char* other : {"", "watermelon"}) {
    ASSERT_TRUE(StoreAtRest::open(path_, IfMissing::Refuse, {{.id = {1}, .flavour = other}}));
    EXPECT_THAT(all("SELECT flavour FROM v_designs"), ElementsAre(Cells{"chocolate"}))
        << "it has one already";
  }
}

TEST_F(AtRestTest, LeavesTheCampaignThatRunsThereAlone) {
  const SyntheticCampaign made = synthetic_campaign({.designs = 2, .iterations = 1});
  { ASSERT_TRUE(Store::open(path_, made.campaign, made.designs)); }
  const auto designs = static_cast<std::int64_t>(made.designs.size());
  {
    auto store = value_of(StoreAtRest::open(path_, IfMissing::Refuse));
    EXPECT_FALSE(store->is_new());
    ASSERT_TRUE(store->add(imported(designs + 1, 1)));
  }
  auto store = value_of(Store::open(path_, made.campaign, made.designs));
  EXPECT_EQ(store->design_states().size(), made.designs.size());
  EXPECT_FALSE(store->finished());
  store->append({CampaignStateRow{.state = "finished"}});
  store->flush();
  EXPECT_TRUE(store->finished());
  EXPECT_THAT(all("SELECT state FROM v_campaign_status ORDER BY state"),
              ElementsAre(Cells{"finished"}, Cells{"imported"}));
}

}  // namespace
}  // namespace swarmsmith
