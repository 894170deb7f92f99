#include "analysis/comparison/comparison.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "storage/rows.h"
#include "tests/storage/fixture.h"
#include "tests/support/checks.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

/// A store with finished designs whose winners were tested.
struct ComparisonStoreTest : FilledStore {
  ComparisonStoreTest() : FilledStore(synthetic_campaign({.designs = 3, .tests = 4})) {}
};

TEST_F(ComparisonStoreTest, SummarisesTheWinnersTests) {
  const auto comparison = value_of(compare(*reader, {.by = CompareBy::Mission}));
  std::size_t runs = 0;
  for (const ComparedGroup& group : comparison.groups)
    runs += group.runs;
  EXPECT_EQ(runs, 12U);
  const auto mean = cells_of(
      *reader, "SELECT avg(m) FROM (SELECT avg(score) AS m FROM v_design_scores WHERE mission = '" +
                   comparison.groups.front().mission + "' AND method = '" +
                   comparison.groups.front().method + "' GROUP BY design)");
  EXPECT_NEAR(comparison.groups.front().summary.mean, std::stod(mean.front().front()), 1e-9);
}

/// How a design ended. `more`: an extension of its budget by a user, which took effect after
/// `step`, or has not yet.
struct Ended {
  std::string method;
  std::int64_t used = 1000;
  std::int64_t budget = 1000;
  DesignState state = DesignState::Finished;
  std::string mission = "m";
  std::int64_t more = 0;
  std::optional<std::int64_t> step = 1;
};

/// A store of three designs, which ended like this.
std::unique_ptr<StoreReader> store_of(const std::filesystem::path& file,
                                      const std::vector<Ended>& ended) {
  SyntheticCampaign made =
      synthetic_campaign({.designs = 3, .iterations = 1, .candidates = 3, .steps = 1, .tests = 1});
  std::vector<Row> more;
  for (std::size_t i = 0; i < made.designs.size(); ++i) {
    DesignRow& design = made.designs[i];
    design.mission = ended[i].mission;
    design.method = ended[i].method;
    design.budget = ended[i].budget;
    for (const auto& batch : made.batches) {
      for (const Row& row : batch) {
        const auto* state = std::get_if<DesignStateRow>(&row);
        if (state == nullptr || state->state != DesignState::Finished) continue;
        if (state->design != design.id) continue;
        DesignStateRow end = *state;
        end.used = ended[i].used;
        end.state = ended[i].state;
        more.emplace_back(end);
      }
    }
    if (ended[i].more > 0) {
      more.emplace_back(CommandRow{.number = 1,
                                   .kind = CommandKind::Extend,
                                   .design = design.id,
                                   .step = ended[i].step,
                                   .budget = ended[i].more});
    }
  }
  filled_store(file, made)->append(std::move(more));
  return open_reader(file);
}

TEST(ComparisonOfStores, SaysWhichMethodsUsedMuchLessOrMoreThanTheirBudget) {
  constexpr auto kRacing = DesignState::Racing;
  const std::string of_all = ": compare with what the others used";
  const std::string of_other = "other used 48 % of its experiments (480 of 1000)" + of_all;
  struct Case {
    std::string what;
    std::vector<Ended> designs;
    ComparisonOptions options;
    std::vector<std::string> notes;
  };
  const std::vector<Case> cases = {
      {"95 % is enough",
       {{"all", 950}, {"other", 1000}, {"other", 10, 1000, kRacing}},
       {.by = CompareBy::Method},
       {}},
      {"finished designs count",
       {{"all", 940}, {"other", 480}, {"other", 10, 1000, kRacing}},
       {.by = CompareBy::Method},
       {"all used 94 % of its experiments (940 of 1000)" + of_all, of_other}},
      {"designs of a method are taken together",
       {{"all", 1000}, {"other", 600}, {"other", 1000}},
       {.by = CompareBy::Method},
       {"other used 80 % of its experiments (1600 of 2000)" + of_all}},
      {"missions that are compared count",
       {{"all"}, {"other", 480}, {.method = "all", .used = 10, .mission = "n"}},
       {.by = CompareBy::Method, .missions = {"m"}},
       {of_other}},
      {"methods that are compared count",
       {{"all"}, {"other", 480}, {"third", 10}},
       {.by = CompareBy::Method, .method = "other"},
       {}},
      {"only methods have budgets",
       {{"all"}, {"other", 480}, {"other", 480}},
       {.by = CompareBy::Mission},
       {}},
      {"without a budget there is no part of it",
       {{"all", 0, 0}, {"other", 480}, {"other", 10, 1000, kRacing}},
       {.by = CompareBy::Method},
       {}},
      {"an extension gave it more than others had",
       {{"all"}, {.method = "other", .used = 1500, .more = 500}, {"other", 10, 1000, kRacing}},
       {.by = CompareBy::Method},
       {"other used 150 % of its experiments (1500 of 1000), since it was extended" + of_all}},
      {"an extension that has not taken effect gave nothing yet",
       {{"all"},
        {.method = "other", .used = 480, .more = 500, .step = std::nullopt},
        {"other", 10, 1000, kRacing}},
       {.by = CompareBy::Method},
       {of_other}},
  };
  for (const auto& [what, ended, options, expected] : cases) {
    const TemporaryFolder folder;
    std::vector<std::string> notes =
        value_of(compare(*store_of(folder / "s.db", ended), options)).notes;
    std::erase_if(notes, [](const std::string& note) {
      return note.find(" of its experiments ") == std::string::npos;
    });
    EXPECT_EQ(notes, expected) << what;
  }
}

TEST(ComparisonOfStores, NamesWhatThereIsWhenSomethingElseIsAskedFor) {
  const TemporaryFolder folder;
  const auto store = store_of(folder / "three.db", {{.method = "a", .mission = "m"},
                                                    {.method = "a", .mission = "m"},
                                                    {.method = "b", .mission = "n"}});
  struct Case {
    ComparisonOptions options;
    std::string message;
    std::string where;
  };
  for (const auto& [options, message, where] : std::vector<Case>{
           {{.missions = {"m", "nowhere"}},
            "there are no scores of mission `nowhere`; there are m, n",
            "--mission"},
           {{.method = "c"}, "there are no scores of method `c`; there are a, b", "--method"},
           {{.source = "real"}, "there are no scores of source `real`; there are rvr", "--source"},
           {{.choice = {.purpose = "score", .unit = {}}},
            "there are no scores of purpose `score`; there are test",
            "--purpose"},
           {{.missions = {"m"}, .method = "b"},
            "no score matches the given mission, method, source and purpose",
            ""},
       }) {
    const Error error = why_not(compare(*store, options));
    EXPECT_EQ(error.kind, ErrorKind::NotFound);
    EXPECT_EQ(error.message, message);
    EXPECT_EQ(error.where, where);
  }
  EXPECT_TRUE(compare(*store, {.choice = {.purpose = "all", .unit = {}}}));
}

TEST(ComparisonOfStores, WithoutAFinishedDesignSayHowToGetScores) {
  const TemporaryFolder folder;
  const SyntheticCampaign other = synthetic_campaign({.designs = 1});
  open_store(folder / "empty.db", other).reset();
  const Error comparison = why_not(compare(*open_reader(folder / "empty.db"), {}));
  EXPECT_EQ(comparison.kind, ErrorKind::NotFound);
  EXPECT_THAT(comparison.message, HasSubstr("swarmsmith ls designs"));
}

}  // namespace
}  // namespace swarmsmith
