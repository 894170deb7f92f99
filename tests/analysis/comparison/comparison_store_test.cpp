#include "analysis/comparison/comparison.h"
#include "tests/storage/fixture.h"
#include "tests/support/checks.h"

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

/// Two methods of one design with a budget of 1,000, which used so much; a user extended the second
/// one by `more`. The second one has another design, which is not finished.
Expected<Comparison> compared_budgets(const std::filesystem::path& file, std::int64_t all,
                                      std::int64_t other, CompareBy by, std::int64_t more = 0) {
  SyntheticCampaign made = synthetic_campaign({.designs = 3, .tests = 4});
  for (DesignRow& design : made.designs) {
    design.mission = "m";
    design.method = design.id == made.designs[0].id ? "all" : "other";
    design.budget = 1000;
  }
  {
    auto store = open_store(file, made);
    for (const auto& batch : made.batches)
      store->append(batch);
    std::vector<Row> ends;
    for (const auto& batch : made.batches) {
      for (const Row& row : batch) {
        const auto* state = std::get_if<DesignStateRow>(&row);
        if (state == nullptr || state->state != DesignState::Finished) continue;
        DesignStateRow end = *state;
        end.used = end.design == made.designs[0].id ? all : other;
        if (end.design == made.designs[2].id) {
          end.state = DesignState::Racing;
          end.used = 10;
        }
        ends.emplace_back(end);
      }
    }
    EXPECT_EQ(ends.size(), 3U);
    store->append(std::move(ends));
    if (more > 0) {
      store->append({CommandRow{.number = 1,
                                .kind = CommandKind::Extend,
                                .design = made.designs[1].id,
                                .step = 1,
                                .budget = more}});
    }
  }
  const auto two = open_reader(file);
  return compare(*two, {.by = by});
}

TEST_F(ComparisonStoreTest, SaysWhichMethodUsedMuchLessThanItsBudget) {
  const auto comparison =
      value_of(compared_budgets(folder / "two.db", 960, 480, CompareBy::Method));
  EXPECT_THAT(comparison.notes,
              Contains("other used 48 % of its experiments (480 of 1000): compare with what "
                       "the others used"));
  EXPECT_THAT(comparison.notes, Not(Contains(HasSubstr("all used"))));
  EXPECT_THAT(compared_budgets(folder / "by_mission.db", 960, 480, CompareBy::Mission)->notes,
              Not(Contains(HasSubstr("of its experiments"))));
}

TEST_F(ComparisonStoreTest, SaysWhichMethodWasExtended) {
  const auto comparison =
      value_of(compared_budgets(folder / "two.db", 1000, 2300, CompareBy::Method, 1300));
  EXPECT_THAT(comparison.notes,
              Contains("other used 230 % of its experiments (2300 of 1000), since it was "
                       "extended: compare with what the others used"));
  EXPECT_THAT(comparison.notes, Not(Contains(HasSubstr("all used"))));
}

TEST_F(ComparisonStoreTest, NamesWhatThereIsWhenSomethingElseIsAskedFor) {
  const Error mission = why_not(compare(*reader, {.missions = {"nowhere"}}));
  EXPECT_EQ(mission.kind, ErrorKind::NotFound);
  EXPECT_EQ(mission.where, "--mission");
  EXPECT_THAT(mission.message, HasSubstr("`nowhere`; there are "));
  EXPECT_THAT(complaint_of(compare(*reader, {.source = "real"})), HasSubstr("there are rvr"));
}

TEST_F(ComparisonStoreTest, AStoreWithoutAFinishedDesignSaysHowToGetScores) {
  const SyntheticCampaign other = synthetic_campaign({.designs = 1});
  open_store(folder / "empty.db", other).reset();
  const Error comparison = why_not(compare(*open_reader(folder / "empty.db"), {}));
  EXPECT_EQ(comparison.kind, ErrorKind::NotFound);
  EXPECT_THAT(comparison.message, HasSubstr("swarmsmith ls designs"));
}

}  // namespace
}  // namespace swarmsmith
