#include <cmath>
#include <limits>

#include "base/special_functions.h"
#include "irace_core/internal/means.h"
#include "irace_core/internal/race.h"
#include "irace_core/internal/ranking.h"
#include "tests/irace_core/costs.h"
#include "tests/support/checks.h"

namespace swarmsmith::irace {
namespace {

using ::testing::DoubleNear;
using ::testing::Each;
using ::testing::Key;

constexpr double kRejects = std::numeric_limits<double>::infinity();

RaceSettings race_on(std::int64_t pairs) {
  RaceSettings settings{.min_survival = 1, .max_experiments = 1000, .pairs = {}};
  for (std::int64_t pair = 1; pair <= pairs; ++pair)
    settings.pairs.push_back(pair);
  return settings;
}

std::vector<Contestant> newcomers(std::int64_t count) {
  std::vector<Contestant> contestants;
  for (std::int64_t id = 1; id <= count; ++id)
    contestants.push_back({id, {}, {}});
  return contestants;
}

/// Answers what is wanted; `cost` sees the run, the configuration's id and the pair.
template <class Cost>
void answer(Race& race, Cost cost) {
  std::vector<double> costs;
  for (const RaceRun& run : race.wanted()) {
    costs.push_back(cost(run, static_cast<double>(race.contestant(run.column).id),
                         static_cast<double>(race.pair_of(run.task))));
  }
  race.tell(testing::measured(costs));
}

/// Each of four is the best on every fourth pair.
void run_to_the_end(Race& race) {
  while (!race.finished())
    answer(race, [](const RaceRun&, double id, double pair) { return std::fmod(id + pair, 4); });
}

TEST(TTest, AdjustsForTheNumberOfTests) {
  const std::vector<double> p{0.01, 0.04, 0.03, 1};
  EXPECT_EQ(adjusted(p, TestType::TTest), p);
  EXPECT_THAT(adjusted(p, TestType::TTestBonferroni), ElementsAre(0.04, 0.16, 0.12, 1));
  // Smallest times 4, then 0.03 * 3, then 0.04 * 2 which may not be smaller.
  EXPECT_THAT(adjusted(p, TestType::TTestHolm), ElementsAre(0.04, 0.09, 0.09, 1));
  const std::vector<double> large{0.5, 0.4};
  EXPECT_THAT(adjusted(large, TestType::TTestBonferroni), ElementsAre(1, 0.8));
  EXPECT_THAT(adjusted({0.9, 0.8}, TestType::TTestHolm), ElementsAre(1, 1));
}

TEST(TTest, ComparesEachWithTheBestMean) {
  // Differences to the best 1, 2, 3, -2: mean 1, variance 14/3, t = 1 / sqrt(14/12).
  const std::vector<double> best{1, 2, 3, 4};
  const std::vector<double> other{2, 4, 6, 2};
  const std::vector<double> always_worse{1.5, 2.5, 3, 4.5};
  const std::vector<double> constant{9, 9, 9, 9};
  const std::vector<std::span<const double>> costs{other, best, always_worse, constant};
  const std::vector<double> means{mean_of(other), mean_of(best), mean_of(always_worse), 9};
  const std::vector<std::size_t> columns{3, 5, 8, 9};
  const TestResult result = paired_t_tests(costs, means, columns, 0.05, TestType::TTest);
  EXPECT_THAT(result.dropped, ElementsAre(8U, 9U));
  EXPECT_NEAR(result.statistic, 1 / std::sqrt(14.0 / 12), 1e-12);
  EXPECT_EQ(result.p_value, 0);
}

/// Differences 1, 2, 3, -2 as above: p of t = 1 / sqrt(14/12) with 3 degrees of freedom.
TEST(TTest, DropsWhatHasASmallerPThanAlpha) {
  const std::vector<double> best{1, 2, 3, 4};
  const std::vector<double> other{2, 4, 6, 2};
  const auto tested = [&](double alpha) {
    return paired_t_tests(std::vector<std::span<const double>>{best, other},
                          std::vector<double>{2.5, 3.5}, std::vector<std::size_t>{0, 1}, alpha,
                          TestType::TTest);
  };
  const double p = student_t_two_sided_tail(1 / std::sqrt(14.0 / 12), 3);
  EXPECT_NEAR(tested(0.05).p_value, p, 1e-12);
  EXPECT_THAT(tested(p * 0.999).dropped, IsEmpty());
  EXPECT_THAT(tested(tested(0.05).p_value).dropped, IsEmpty());
  EXPECT_THAT(tested(p * 1.001).dropped, ElementsAre(1U));
}

TEST(TTest, KeepsEqualMeans) {
  const std::vector<double> up{1, 2, 3};
  const std::vector<double> down{3, 2, 1};
  const TestResult result = paired_t_tests(std::vector<std::span<const double>>{up, down},
                                           std::vector<double>{2, 2 + 1e-9},
                                           std::vector<std::size_t>{0, 1}, 0.99, TestType::TTest);
  EXPECT_THAT(result.dropped, IsEmpty());
  EXPECT_EQ(result.p_value, 1);
}

TEST(Means, DoNotDependOnTheOrder) {
  // A plain sum loses the small ones on one side of the large ones.
  EXPECT_EQ(mean_of(std::vector<double>{1e16, 1, -1e16, 1}), 0.5);
  EXPECT_EQ(mean_of(std::vector<double>{0.1, 0.2, 0.3, 0.7}),
            mean_of(std::vector<double>{0.7, 0.3, 0.2, 0.1}));
}

TEST(OverallRanks, RankMeansForTTests) {
  const double none = std::nan("");
  // By rank sums the first (1 1 2) beats the second (2 2 1), by means it does not.
  const std::vector<std::vector<double>> costs{{1, 1, 99}, {2, 2, 1}, {0, none, none}};
  EXPECT_THAT(overall_ranks(costs, TestType::FTest), ElementsAre(4, 5, 6));
  EXPECT_THAT(overall_ranks(costs, TestType::TTestHolm), ElementsAre(2, 1, 3));
}

TEST(Race, TellsTheBestByMeansInTTests) {
  RaceSettings settings = race_on(10);
  settings.test_type = TestType::TTest;
  Race race(settings, newcomers(2));
  answer(race, [](const RaceRun&, double id, double pair) {
    return id == 1 ? (pair == 5 ? 99.0 : 1.0) : 2.0 + 0.01 * pair;
  });
  const std::vector<RaceStep> steps = race.take_steps();
  EXPECT_EQ(steps[3].best, 1);
  EXPECT_EQ(steps[4].best, 2);
}

TEST(NonElitistRace, ProtectsNoneAndHasNoLimit) {
  RaceSettings settings = race_on(12);
  settings.elitist = false;
  settings.elitist_limit = 1;
  Race race(settings, newcomers(4));
  run_to_the_end(race);
  EXPECT_EQ(race.stop_reason(), "no pairs left");
  EXPECT_EQ(race.used(), 48);
}

TEST(NonElitistRace, StopsBeforeATestThatItCannotPay) {
  RaceSettings settings = race_on(40);
  settings.elitist = false;
  settings.first_test = 4;
  settings.pairs_between_tests = 2;
  settings.max_experiments = 31;
  Race race(settings, newcomers(4));
  run_to_the_end(race);
  EXPECT_EQ(race.used(), 24);  // after six pairs two more would make 32
}

TEST(Race, AsksForOneTaskAtATimeWhenToldTo) {
  RaceSettings settings = race_on(40);
  settings.one_task_at_a_time = true;
  Race race(settings, newcomers(3));
  for (std::size_t task = 0; task < 5; ++task) {
    EXPECT_THAT(race.wanted(), ElementsAre(RaceRun{task, 0}, RaceRun{task, 1}, RaceRun{task, 2}));
    answer(race, [](const RaceRun&, double id, double) { return id; });
  }
  EXPECT_TRUE(race.finished());
}

/// Pair 3 is new, 1 and 2 are past, and configuration 7 knows them.
Race evaluated_race() {
  RaceSettings settings = race_on(10);
  settings.pairs = {3, 1, 2, 4, 5, 6, 7};
  settings.new_pairs = 1;
  settings.past_pairs = 2;
  settings.target_evaluator = true;
  return Race(settings, {{7, {70, 71}, {}}, {8, {}, {}}, {9, {}, {}}});
}

TEST(EvaluatedRace, CallsForAllWhoAreAliveAfterTheRunsOfATask) {
  Race race = evaluated_race();
  EXPECT_THAT(race.wanted(), ElementsAre(RaceRun{0, 0}, RaceRun{0, 1}, RaceRun{0, 2}));
  // What runs cost is not looked at.
  race.tell(std::vector<Measurement>{{kRejects, 2}, {std::nan(""), 3}, {1, 4}});
  EXPECT_THAT(race.wanted(),
              ElementsAre(RaceRun{0, 0, 0, true}, RaceRun{0, 1, 0, true}, RaceRun{0, 2, 0, true}));
  EXPECT_EQ(race.used(), 0);
  answer(race, [](const RaceRun&, double id, double) { return id; });
  EXPECT_EQ(race.used(), 3);
  // On pair 1 the elite is not run, but called for.
  EXPECT_THAT(race.wanted(), ElementsAre(RaceRun{1, 1}, RaceRun{1, 2}));
  answer(race, [](const RaceRun&, double, double) { return 0.0; });
  EXPECT_THAT(race.wanted(),
              ElementsAre(RaceRun{1, 0, 0, true}, RaceRun{1, 1, 0, true}, RaceRun{1, 2, 0, true}));
  answer(race, [](const RaceRun&, double id, double) { return 10.0 * id; });
  EXPECT_EQ(race.used(), 5);
  const std::vector<RaceStep> steps = race.take_steps();
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_THAT(steps[1].evaluated, ElementsAre(Key(8), Key(9)));
  EXPECT_EQ(steps[1].best, 7);
  EXPECT_EQ(steps[1].mean_best, (7 + 70) / 2.0);
}

TEST(EvaluatedRace, ReportsCostsThatTookThePlaceOfKnownOnes) {
  Race race = evaluated_race();
  for (int i = 0; i < 4; ++i) {
    answer(race, [](const RaceRun& run, double id, double pair) {
      return run.is_evaluation ? 100.0 * id + pair : 0;
    });
  }
  const std::vector<Race::Result> results = race.results(0);
  ASSERT_EQ(results.size(), 2U);
  EXPECT_EQ(results[0].pair, 3);
  EXPECT_FALSE(results[0].replaces);
  EXPECT_EQ(results[1].pair, 1);
  EXPECT_EQ(results[1].cost, 701);
  EXPECT_TRUE(results[1].replaces);
}

TEST(EvaluatedRace, RejectsByTheEvaluatorsWord) {
  Race race = evaluated_race();
  answer(race, [](const RaceRun&, double, double) { return 0.0; });
  answer(race, [](const RaceRun&, double id, double) { return id == 7 ? kRejects : id; });
  EXPECT_TRUE(race.is_rejected(0));
  EXPECT_THAT(race.alive_ids(), ElementsAre(8, 9));
  EXPECT_EQ(race.used(), 3);
}

TEST(Race, RunsBlocksBetweenTests) {
  // Blocks of three pairs, a test after every second block: T_f = T_e = 6.
  RaceSettings settings = race_on(40);
  settings.first_test = 6;
  settings.pairs_between_tests = 6;
  settings.block_size = 3;
  settings.elitist_limit = 1;
  Race race(settings, newcomers(4));
  EXPECT_EQ(race.wanted().size(), 24U);
  run_to_the_end(race);
  EXPECT_EQ(race.used(), 48);
}

}  // namespace
}  // namespace swarmsmith::irace
