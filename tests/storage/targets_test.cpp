#include <cmath>

#include "storage/answer.h"
#include "storage/internal/schema.h"
#include "storage/internal/sqlite.h"
#include "tests/storage/fixture.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

using Cells = std::vector<std::string>;

constexpr DesignId kDesign{1};
constexpr CandidateId kWinner = candidate_id(kDesign, 1);
constexpr CandidateId kLoser = candidate_id(kDesign, 2);

EvaluationRow run(CandidateId candidate, Purpose purpose, std::int64_t pair, double score) {
  EvaluationRow row;
  row.key = {candidate, purpose, pair};
  row.iteration = purpose == Purpose::Race ? 1 : 0;
  row.measured.score = score;
  row.source = "command";
  return row;
}

/// A design of programs: two candidates on one pair, one of them dropped in the race and again in
/// the one after the last; times, bounds, calls of an evaluator, failures.
struct TargetsTest : testing::Test {
  TemporaryFolder folder;
  SyntheticCampaign campaign;

  TargetsTest() {
    campaign.campaign = {.name = "t", .digest = "d", .deciding = "{}", .file = "", .seed = 1};
    campaign.designs.push_back({.id = kDesign, .mission = "tuning", .method = "irace"});
    std::vector<Row> rows;
    for (const CandidateId id : {kWinner, kLoser}) {
      CandidateRow candidate;
      candidate.id = id;
      candidate.iteration = 1;
      candidate.machine = "--alpha 2";
      rows.emplace_back(candidate);
    }
    rows.emplace_back(PairRow{.design = kDesign, .number = 1, .instance = 3, .seed = 71});
    for (std::int64_t i = 1; i <= 2; ++i) {
      IterationRow iteration{.design = kDesign, .number = i, .of = 1};
      iteration.postselection = i == 2;
      rows.emplace_back(iteration);
      RaceStepRow step{.design = kDesign, .step = i, .iteration = i, .pair = 1};
      if (i == 1) step.bound = 2.5;
      rows.emplace_back(step);
      rows.emplace_back(
          EliminationRow{.candidate = kLoser, .iteration = i, .step = i, .reason = "test"});
      rows.emplace_back(
          EliteRow{.design = kDesign, .iteration = i, .rank = 1, .candidate = kWinner, .mean = -4});
    }
    EvaluationRow timed = run(kWinner, Purpose::Race, 1, -4);
    timed.measured.time = 1.25;
    timed.bound = 2.5;
    rows.emplace_back(timed);
    EvaluationRow rejected = run(kLoser, Purpose::Race, 1, 0);
    rejected.status = EvaluationStatus::Rejected;
    rows.emplace_back(rejected);
    rows.emplace_back(FailureRow{.key = timed.key,
                                 .attempt = 1,
                                 .worker = 0,
                                 .reason = "exit status 3",
                                 .command = "./runner 1 3 71 a.tsp",
                                 .output = "",
                                 .errors = "no licence\n"});
    rows.emplace_back(
        DesignStateRow{.design = kDesign, .state = DesignState::Finished, .best = kWinner});
    campaign.batches.push_back(std::move(rows));
  }

  std::vector<Cells> all(const std::string& sql) {
    fill_store(folder / "s.db", campaign);
    return cells_of(*open_reader(folder / "s.db"), sql);
  }
};

TEST_F(TargetsTest, ViewsShowTimesAndBounds) {
  EXPECT_THAT(
      all("SELECT id, score, time, bound FROM v_evaluations"),
      ElementsAre(Cells{"e100001", "-4", "1.25", "2.5"}, Cells{"e200001", "NULL", "NULL", "NULL"}));
  EXPECT_THAT(all("SELECT step, bound FROM v_race_steps"),
              ElementsAre(Cells{"1", "2.5"}, Cells{"2", "NULL"}));
  EXPECT_THAT(all("SELECT iteration, postselection FROM v_iterations"),
              ElementsAre(Cells{"1", "0"}, Cells{"2", "1"}));
}

TEST_F(TargetsTest, FailuresAreAttemptsAndRejectionsWithoutOne) {
  EXPECT_THAT(
      all("SELECT id, reason, command, errors FROM v_failures ORDER BY id"),
      ElementsAre(Cells{"e100001", "exit status 3", "./runner 1 3 71 a.tsp", "no licence\n"},
                  Cells{"e200001", "rejected", "NULL", "NULL"}));
}

TEST_F(TargetsTest, AnEvaluationOfAnyPurposeHasOneIdAndOneWordInAllViews) {
  constexpr auto kLast = static_cast<int>(Purpose::Transfer);
  for (int number = 0; number <= kLast; ++number) {
    const EvaluationRow made = run(kWinner, static_cast<Purpose>(number), 8, 1);
    campaign.batches.front().emplace_back(made);
    campaign.batches.front().emplace_back(FailureRow{.key = made.key, .reason = "planted"});
    campaign.batches.front().emplace_back(AttemptRow{.key = made.key});
  }
  const std::string count = std::to_string(kLast + 1);
  EXPECT_THAT(
      all("SELECT count(DISTINCT id), count(DISTINCT purpose) FROM v_evaluations WHERE pair = 8"),
      ElementsAre(Cells{count, count}));
  EXPECT_THAT(all("SELECT count(DISTINCT id) FROM v_failures JOIN v_evaluations USING (id, purpose)"
                  " WHERE reason = 'planted'"),
              ElementsAre(Cells{count}));
  EXPECT_THAT(all("SELECT count(DISTINCT id) FROM v_attempts JOIN v_evaluations AS e USING (id)"
                  " WHERE e.pair = 8"),
              ElementsAre(Cells{count}));
}

TEST_F(TargetsTest, ACandidateThatIsDroppedTwiceIsOneCandidateInTwoRaces) {
  EXPECT_THAT(all("SELECT candidate, eliminated_in FROM v_candidates"),
              ElementsAre(Cells{"1", "NULL"}, Cells{"2", "2"}));
  EXPECT_THAT(all("SELECT step, candidate FROM v_race_matrix ORDER BY step, candidate"),
              ElementsAre(Cells{"1", "1"}, Cells{"1", "2"}, Cells{"2", "1"}, Cells{"2", "2"}));
}

TEST_F(TargetsTest, ScoresOfWinnersAreThoseOfTheEvaluatorWhereThereIsOne) {
  auto& rows = campaign.batches.front();
  const PairRow test{
      .design = kDesign, .purpose = Purpose::Test, .number = 1, .instance = 1, .seed = 9};
  PairRow call = test;
  call.purpose = Purpose::Evaluator;
  call.number = 5;
  call.instance = -1;
  rows.emplace_back(test);
  rows.emplace_back(call);
  rows.emplace_back(run(kWinner, Purpose::Test, 1, 0));
  rows.emplace_back(run(kWinner, Purpose::Evaluator, 5, -7));
  EXPECT_THAT(all("SELECT pair, score FROM v_design_scores"), ElementsAre(Cells{"1", "-7"}));
  EXPECT_THAT(all("SELECT test_mean, test_runs FROM v_leaderboard"), ElementsAre(Cells{"-7", "1"}));
  EXPECT_THAT(all("SELECT id, purpose FROM v_evaluations WHERE purpose = 'evaluator'"),
              ElementsAre(Cells{"e100005v", "evaluator"}));
}

TEST_F(TargetsTest, RowsComeBackAsTheyWereAndReplayGetsTimesAndBounds) {
  all("SELECT 1");
  const auto reader = open_reader(folder / "s.db");
  std::size_t found = 0;
  for (const Row& row : reader->answer_rows()) {
    for (const Row& written : campaign.batches.front())
      found += same_answer(row, written) ? 1U : 0U;
  }
  // All but the failure, which is not part of the answer.
  EXPECT_EQ(found, campaign.batches.front().size() - 1);
  const auto scores = reader->scores();
  ASSERT_EQ(scores.size(), 2U);
  EXPECT_EQ(scores[0].measured.time, 1.25);
  EXPECT_EQ(scores[0].bound, 2.5);
  EXPECT_EQ(scores[1].measured.time, 0);
}

TEST_F(TargetsTest, TimesAndBoundsArePartOfTheAnswer) {
  const EvaluationRow plain = run(kWinner, Purpose::Race, 1, -4);
  EvaluationRow timed = plain;
  timed.measured.time = 1;
  EvaluationRow bounded = plain;
  bounded.bound = 1;
  EXPECT_FALSE(same_answer(plain, timed));
  EXPECT_FALSE(same_answer(plain, bounded));
  EXPECT_FALSE(same_answer(timed, bounded));
  EXPECT_TRUE(in_answer(run(kWinner, Purpose::Evaluator, 1, -4)));
}

TEST_F(TargetsTest, ATimeThatIsNoNumberIsNotStored) {
  auto store = open_store(folder / "s.db", campaign);
  EvaluationRow bad = run(kWinner, Purpose::Race, 1, -4);
  bad.measured.time = NAN;
  EXPECT_THROW(store->append({Row(bad)}), std::invalid_argument);
}

}  // namespace
}  // namespace swarmsmith
