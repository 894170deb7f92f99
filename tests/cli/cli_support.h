#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "cli/commands/commands.h"
#include "coordinator/campaign/campaign_file.h"
#include "coordinator/campaign/campaign_rows.h"
#include "storage/store.h"
#include "tests/support/one_design.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith::cli {

/// What a run of the program gave.
struct Ran {
  int code = 0;
  std::string out;
  std::string err;
};

/// Runs the program within this process.
inline Ran run(const std::vector<std::string>& arguments) {
  std::ostringstream out;
  std::ostringstream err;
  Output output{.out = out, .err = err};
  const ExitCode code = run_program(arguments, output);
  return {static_cast<int>(code), out.str(), err.str()};
}

/// The same where all is well.
inline Ran run_well(const std::vector<std::string>& arguments) {
  Ran ran = run(arguments);
  EXPECT_EQ(ran.code, 0) << testing::PrintToString(arguments) << ": " << ran.err;
  return ran;
}

/// What is said of words or files that are wrong, with exit code 2 and nothing beside it.
inline std::string refusal(const std::vector<std::string>& arguments) {
  const Ran ran = run(arguments);
  EXPECT_EQ(ran.code, 2) << testing::PrintToString(arguments);
  EXPECT_EQ(ran.out, "") << testing::PrintToString(arguments);
  return ran.err;
}

inline const std::string kExploreText = "--nstates 1 --s0 0 --rwm0 10";
inline const std::string kStopText = "--nstates 1 --s0 1";

inline void write_file(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file) << text;
}

/// A store with one finished design of two candidates, c1 (the winner, child of c2) and c2.
inline void write_store(const std::filesystem::path& file,
                        const Campaign& campaign = one_design_campaign()) {
  auto store = Store::open(file, campaign_row(campaign), design_rows(campaign));
  ASSERT_TRUE(store) << to_string(store.error());
  const DesignId design{1};
  const CandidateId winner = candidate_id(design, 1);
  const CandidateId parent = candidate_id(design, 2);
  std::vector<Row> rows = {
      IterationRow{.design = design, .number = 1, .of = 2, .budget = 100, .configurations = 2},
      CandidateRow{.id = parent,
                   .iteration = 1,
                   .parent = {},
                   .parameters = R"({"S0":"stop"})",
                   .machine = kStopText,
                   .modules = R"({"stop":1})",
                   .states = 1,
                   .transitions = 0},
      CandidateRow{.id = winner,
                   .iteration = 1,
                   .parent = parent,
                   .parameters = R"({"S0":"exploration","RWM0":10})",
                   .machine = kExploreText,
                   .modules = R"({"exploration":1})",
                   .states = 1,
                   .transitions = 0},
      PairRow{.design = design, .purpose = Purpose::Race, .number = 1, .instance = 1, .seed = 77},
      EvaluationRow{.key = {winner, Purpose::Race, 1},
                    .iteration = 1,
                    .measured = {.score = 2.5},
                    .source = "rvr"},
      EvaluationRow{.key = {parent, Purpose::Race, 1},
                    .iteration = 1,
                    .measured = {.score = 0.5},
                    .source = "rvr"},
      CandidateTotalsRow{.candidate = winner, .runs = 1, .score_sum = 2.5, .score_squares = 6.25},
      CandidateTotalsRow{.candidate = parent, .runs = 1, .score_sum = 0.5, .score_squares = 0.25},
      EliminationRow{
          .candidate = parent, .iteration = 1, .step = 1, .rank_sum = 2, .reason = "test"},
      EliteRow{
          .design = design, .iteration = 1, .rank = 1, .candidate = winner, .mean = 2.5, .runs = 1},
      PairRow{.design = design, .purpose = Purpose::Test, .number = 1, .instance = 1, .seed = 99},
      EvaluationRow{.key = {winner, Purpose::Test, 1}, .measured = {.score = 3}, .source = "rvr"},
      DesignStateRow{.design = design,
                     .state = DesignState::Finished,
                     .used = 2,
                     .iteration = 1,
                     .best = winner,
                     .best_mean = 2.5,
                     .reason = "budget exhausted"},
      CampaignStateRow{.state = "finished"},
  };
  (*store)->append(std::move(rows));
  (*store)->flush();
}

/// A folder with such a store in it.
class WithStore : public testing::Test {
 protected:
  void SetUp() override { write_store(store_); }

  TemporaryFolder folder_;
  std::string store_ = (folder_ / "demo.db").string();
};

}  // namespace swarmsmith::cli
