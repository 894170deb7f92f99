#include "cli/irace/irace_console.h"

#include <sstream>

#include "cli/irace/irace_report.h"
#include "cli/irace/race_table.h"
#include "coordinator/campaign/campaign_file.h"
#include "coordinator/campaign/campaign_rows.h"
#include "tests/cli/irace/irace_rows.h"
#include "tests/support/checks.h"
#include "tests/support/one_design.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith::cli {
namespace {

using std::chrono::seconds;

class Console : public testing::Test {
 protected:
  IraceConsole console() {
    IraceRun run{.race = {}, .space = ant_space(), .seed = 42, .n_iterations = 4, .budget = 200};
    run.race.max_experiments = 200;
    return {output_, run, TimePoint(), [] { return "DATE"; }};
  }
  /// A row a second.
  static void add(IraceConsole& console, const std::vector<Row>& rows) {
    TimePoint now;
    for (const Row& row : rows)
      console.add(0, row, now += seconds(1));
  }

  std::ostringstream out_;
  std::ostringstream err_;
  Output output_{.out = out_, .err = err_};
};

TEST_F(Console, BeginsWithWhatWillBeDone) {
  console().write_begin();
  EXPECT_EQ(out_.str(),
            "# DATE: Initialization\n"
            "# Elitist race\n"
            "# Elitist new instances: 1\n"
            "# Elitist limit: 2\n"
            "# nbIterations: 4\n"
            "# minNbSurvival: 4\n"
            "# nbParameters: 4\n"
            "# seed: 42\n"
            "# confidence level: 0.95\n"
            "# budget: 200\n"
            "# mu: 5\n"
            "# deterministic: FALSE\n\n");
}

TEST_F(Console, TellsOfARaceAsIraceDoes) {
  IraceConsole irace = console();
  add(irace, ant_rows());
  const std::string second_table = marker_legend() + "\n" + race_headline(false);
  EXPECT_EQ(
      out_.str(),
      "# DATE: Iteration 1 of 2\n"
      "# experimentsUsed: 0\n"
      "# remainingBudget: 200\n"
      "# currentBudget: 10\n"
      "# nbConfigurations: 3\n" +
          marker_legend() + "\n" + race_headline(false) +
          "|x|          1|          2|          1|     14.50000000|          3|00:00:04|   NA|"
          "  NA|    NA|\n"
          "|x|          2|          2|          2|     9.400000000|          5|00:00:02|   NA|"
          "  NA|    NA|\n" +
          race_rule(false) +
          "Best-so-far configuration:           2    mean value:      9.400000000\n"
          "Description of the best-so-far configuration:\n"
          "  .ID. algorithm alpha ants q0 .PARENT.\n"
          "2    2       eas   3.5   17 NA       NA\n"
          "\n"
          "# DATE: Elite configurations (first number is the configuration ID; listed from best to "
          "worst according to the sum of ranks):\n"
          "  algorithm  alpha ants     q0\n"
          "2       eas 3.5000   17     NA\n"
          "1      mmas 3.8452   93 0.8626\n"
          "# DATE: Iteration 2 of 2\n"
          "# experimentsUsed: 5\n"
          "# remainingBudget: 195\n"
          "# currentBudget: 10\n"
          "# nbConfigurations: 2\n"
          "# DATE: Soft restart: configurations were too similar, new ones were sampled from wider "
          "models\n" +
          second_table +
          "|x|          3|          2|          4|     2.000000000|          2|00:00:02|   NA|"
          "  NA|    NA|\n");
}

TEST_F(Console, SaysNothingWhenQuiet) {
  output_.quiet = true;
  IraceConsole irace = console();
  irace.write_begin();
  add(irace, ant_rows());
  irace.finish({});
  EXPECT_THAT(out_.str(), IsEmpty());
}

TEST_F(Console, SaysWhyTheRunEnded) {
  IraceConsole irace = console();
  add(irace, ant_rows());
  irace.add(0,
            DesignStateRow{.design = kOne,
                           .state = DesignState::Testing,
                           .used = 195,
                           .iteration = 2,
                           .best = candidate_id(kOne, 2),
                           .best_mean = -9.4,
                           .reason = "budget exhausted"},
            TimePoint());
  EXPECT_THAT(out_.str(), HasSubstr("# DATE: Stopped: budget exhausted\n# Iteration: 2\n"
                                    "# experimentsUsed: 195\n# remainingBudget: 5\n"));
}

TEST_F(Console, CountsWhatARunWasExtendedBy) {
  IraceConsole irace = console();
  const CommandRow given{
      .number = 1, .kind = CommandKind::Extend, .design = kOne, .step = {}, .budget = 100};
  irace.restore(0, given);
  CommandRow done = given;
  done.step = 2;
  // The same command again, now with the step after which it took effect; and another kind.
  irace.add(0, done, TimePoint());
  irace.add(0, CommandRow{.number = 2, .kind = CommandKind::Pause, .budget = 7}, TimePoint());
  irace.add(0,
            DesignStateRow{.design = kOne, .state = DesignState::Racing, .used = 195, .reason = {}},
            TimePoint());
  irace.add(0, IterationRow{.design = kOne, .number = 3, .of = 3, .budget = 50}, TimePoint());
  EXPECT_THAT(out_.str(), HasSubstr("# experimentsUsed: 195\n# remainingBudget: 105\n"));
  irace.add(0,
            DesignStateRow{.design = kOne,
                           .state = DesignState::Testing,
                           .used = 290,
                           .iteration = 3,
                           .reason = "budget exhausted"},
            TimePoint());
  EXPECT_THAT(out_.str(), HasSubstr("# experimentsUsed: 290\n# remainingBudget: 10\n"));
}

/// A store of the rows above.
class ConsoleOfAStore : public Console {
 protected:
  void SetUp() override {
    const Campaign campaign = one_design_campaign();
    auto store = value_of(Store::open(file_, campaign_row(campaign), design_rows(campaign)));
    store->append(rows_);
    store->flush();
  }
  std::unique_ptr<StoreReader> reader() { return std::move(*StoreReader::open(file_)); }

  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "irace.db";
  std::vector<Row> rows_ = ant_rows();
};

TEST_F(ConsoleOfAStore, TellsBrieflyWhatWasAndGoesOnInTheTable) {
  IraceConsole irace = console();
  ASSERT_TRUE(irace.go_on_from(*reader()));
  EXPECT_EQ(
      out_.str(),
      "# DATE: Continuing after 7 experiments\n"
      "# Iteration 1 of 2: experimentsUsed: 5, best configuration: 2, mean value: 9.4\n"
      "# DATE: Iteration 2 of 2\n"
      "# experimentsUsed: 5\n"
      "# remainingBudget: 195\n"
      "# currentBudget: 10\n"
      "# nbConfigurations: 2\n"
      "# DATE: Soft restart: configurations were too similar, new ones were sampled from "
      "wider models\n" +
          marker_legend() + "\n" + race_headline(false) +
          "|x|          3|          2|          4|     2.000000000|          2|      NA|   NA|"
          "  NA|    NA|\n");
  out_.str("");
  irace.add(0, ant_step(4, 2, 4, 3, 9), TimePoint() + seconds(7));
  EXPECT_EQ(out_.str(),
            "|x|          4|          2|          4|     3.000000000|          4|00:00:07|   NA|"
            "  NA|    NA|\n");
}

TEST_F(ConsoleOfAStore, ReportsAsIraceDoes) {
  const auto result = value_of(read_irace_result(*reader(), ant_space()));
  EXPECT_EQ(best_text(result, {}),
            "# Best configurations (first number is the configuration ID; listed from best to "
            "worst according to the sum of ranks):\n"
            "  algorithm  alpha ants     q0\n"
            "2       eas 3.5000   17     NA\n"
            "1      mmas 3.8452   93 0.8626\n"
            "# Mean costs (and how many runs each is over): 2: 9.4 (2), 1: 11 (2)\n"
            "# Best configurations as commandlines (first number is the configuration ID; same "
            "order as above):\n"
            "2  --eas --alpha 3.5 --ants 17\n"
            "1  --mmas --alpha 3.8452 --ants 93 --q0 0.8626\n");
  EXPECT_EQ(testing_text(result, "DATE"), "");
  Scenario by_mean;
  by_mean.test_type = TestType::TTest;
  EXPECT_THAT(best_text(result, by_mean), HasSubstr("according to the mean value):"));
}

TEST_F(ConsoleOfAStore, GoesOnWithWhatItWasExtendedBy) {
  {
    const Campaign campaign = one_design_campaign();
    auto store = value_of(Store::open(file_, campaign_row(campaign), design_rows(campaign)));
    store->append({CommandRow{
        .number = 1, .kind = CommandKind::Extend, .design = kOne, .step = {}, .budget = 100}});
    store->flush();
  }
  IraceConsole irace = console();
  ASSERT_TRUE(irace.go_on_from(*reader()));
  EXPECT_THAT(out_.str(), HasSubstr("# experimentsUsed: 5\n# remainingBudget: 295\n"));
}

class ConsoleOfTests : public ConsoleOfAStore {
 protected:
  void SetUp() override {
    rows_.emplace_back(
        PairRow{.design = kOne, .purpose = Purpose::Test, .number = 1, .instance = 1, .seed = 5});
    rows_.emplace_back(
        PairRow{.design = kOne, .purpose = Purpose::Test, .number = 2, .instance = 2, .seed = 6});
    for (const std::int64_t number : {1, 2}) {
      for (const std::int64_t pair : {1, 2}) {
        EvaluationRow row{.key = {candidate_id(kOne, number), Purpose::Test, pair}, .source = "t"};
        row.measured.score = static_cast<double>(-10 * number) - 0.5 * static_cast<double>(pair);
        if (number == 2 && pair == 2) row.status = EvaluationStatus::Rejected;
        rows_.emplace_back(row);
      }
    }
    ConsoleOfAStore::SetUp();
  }
};

TEST_F(ConsoleOfTests, ShowsCostsOfTestInstances) {
  const auto result = value_of(read_irace_result(*reader(), ant_space()));
  EXPECT_THAT(testing_text(result, "DATE"),
              HasSubstr(": Testing results (column number is configuration ID in no particular "
                        "order):\n"
                        "      1    2\n"
                        "1t 10.5 20.5\n"
                        "2t 11.0  Inf\n"));
  EXPECT_THAT(result_json(result, "irace.db", 42),
              HasSubstr(R"({"id":1,"instance":"1t","seed":5,"cost":10.5})"));
  EXPECT_THAT(result_json(result, "irace.db", 42),
              HasSubstr(R"("best":[{"id":2,"mean_cost":9.4,"pairs":2,)"
                        R"("parameters":{"algorithm":"eas","alpha":3.5,"ants":17},)"
                        R"("command_line":"--eas --alpha 3.5 --ants 17"},)"));
}

}  // namespace
}  // namespace swarmsmith::cli
