#include "irace_core/internal/capping.h"

#include <algorithm>
#include <limits>

#include "irace_core/internal/race.h"
#include "tests/support/checks.h"

namespace swarmsmith::irace {
namespace {

using ::testing::Key;

constexpr double kRejects = std::numeric_limits<double>::infinity();

TEST(Capping, SummarisesTheElites) {
  const std::vector<double> times{4, 1, 9, 2};
  EXPECT_EQ(summarise(times, CappingType::Median), 3);
  EXPECT_EQ(summarise({4, 1, 9}, CappingType::Median), 4);
  EXPECT_EQ(summarise(times, CappingType::Mean), 4);
  EXPECT_EQ(summarise(times, CappingType::Worst), 9);
  EXPECT_EQ(summarise(times, CappingType::Best), 1);
}

TEST(Capping, RoundsBoundsUp) {
  EXPECT_EQ(round_up(2.001, 0), 3);
  EXPECT_EQ(round_up(2, 0), 2);
  EXPECT_EQ(round_up(2.341, 2), 2.35);
}

TEST(Capping, BoundsACandidateByWhatItHasLeft) {
  const TimeRules rules{.bound_max = 10, .bound_digits = 2};
  // Three pairs at 2 each and 0.01, less 4.5.
  EXPECT_EQ(candidate_bound(2, 3, 4.5, rules), 1.51);
  EXPECT_EQ(candidate_bound(2, 3, 9, rules), 2);  // nothing left: the elites' time
  EXPECT_EQ(candidate_bound(9, 3, 1, rules), 10);
  const TimeRules quarters{.bound_max = 10, .bound_digits = 2, .min_measurable_time = 0.25};
  EXPECT_EQ(candidate_bound(2, 3, 6, quarters), 0.25);
  EXPECT_EQ(candidate_bound(2, 3, 6.25, quarters), 2) << "0 would be no bound";
  EXPECT_EQ(instance_bound(2, rules), 2.01);
  EXPECT_EQ(instance_bound(10, rules), 10);
}

TEST(Capping, ChargesRunsThatWereStopped) {
  TimeRules rules{.bound_max = 10, .bound_par = 5};
  EXPECT_EQ(capped_cost(3, 3, 4, rules), 3);
  EXPECT_EQ(capped_cost(4, 4, 4, rules), 10);     // stopped by its bound
  EXPECT_EQ(capped_cost(10, 10, 10, rules), 50);  // by the largest
  EXPECT_EQ(capped_cost(9.5, 9.5, 10, rules), 9.5);
  EXPECT_EQ(capped_cost(1, 10, 10, rules), 1);  // the largest bound is no timeout
  EXPECT_EQ(capped_cost(kRejects, 1, 4, rules), kRejects);
  EXPECT_EQ(capped_cost(-kRejects, 4, 4, rules), -kRejects);
  rules.bound_as_timeout = false;
  EXPECT_EQ(capped_cost(4, 4, 4, rules), 4);
}

TEST(Capping, FindsThoseAboveTheElites) {
  const std::vector<double> means{2, 4, 3, 3.00002, 5};
  const std::vector<std::size_t> elites{0, 1};
  EXPECT_THAT(dominated(means, elites, CappingType::Median, 2), ElementsAre(1U, 3U, 4U));
  EXPECT_THAT(dominated(means, elites, CappingType::Worst, 2), ElementsAre(4U));
  // Without elites the best two stand in for them: 2 and 3.
  EXPECT_THAT(dominated(means, {}, CappingType::Worst, 2), ElementsAre(1U, 3U, 4U));
  EXPECT_THAT(dominated(means, elites, CappingType::Best, 5), IsEmpty());
  EXPECT_THAT(dominated(means, elites, CappingType::Best, 4), ElementsAre(1U, 2U, 3U, 4U));
  EXPECT_THAT(dominated(std::vector<double>{1, 1 + 1e-5, 1 + 2e-5}, {}, CappingType::Best, 1),
              ElementsAre(2U))
      << "a hundred thousandth is tolerated";
}

/// Pair 4 is new, pairs 1 to 3 are past.
RaceSettings capped_race() {
  RaceSettings settings{.test_type = TestType::TTest,
                        .min_survival = 1,
                        .max_experiments = 1000,
                        .pairs = {4, 1, 2, 3, 5, 6, 7, 8, 9, 10},
                        .new_pairs = 1,
                        .past_pairs = 3};
  settings.capping = true;
  settings.bound_max = 10;
  settings.bound_digits = 2;
  return settings;
}

Contestant elite(std::int64_t id, std::vector<double> past) {
  return {id, past, past};
}

/// Every run takes what `time` says of its configuration, or its bound.
template <class Time>
void answer(Race& race, Time time) {
  std::vector<Measurement> answers;
  for (const RaceRun& run : race.wanted()) {
    const double seconds =
        std::min<double>(time(static_cast<int>(race.contestant(run.column).id)), run.bound);
    answers.push_back({seconds, seconds});
  }
  race.tell(answers);
}

TEST(CappedRace, RunsElitesFirstAndBoundsTheOthersByThem) {
  Race race(capped_race(), {elite(1, {2, 2, 2}), elite(2, {3, 3, 3}), {5, {}, {}}, {6, {}, {}}});
  EXPECT_THAT(race.wanted(), ElementsAre(RaceRun{0, 0, 10}, RaceRun{0, 1, 10}));
  answer(race, [](int id) { return id + 1; });
  // The median of 2 and 3, and 0.01.
  EXPECT_THAT(race.wanted(), ElementsAre(RaceRun{0, 2, 2.51}, RaceRun{0, 3, 2.51}));
  answer(race, [](int id) { return id == 5 ? 1 : 9; });
  const std::vector<RaceStep> steps = race.take_steps();
  ASSERT_EQ(steps.size(), 1U);
  EXPECT_EQ(steps[0].bound, 2.5);
  EXPECT_THAT(steps[0].evaluated, ElementsAre(Key(1), Key(2), Key(5), Key(6)));
  // Stopped at its bound, the last costs as much as bound_max.
  EXPECT_THAT(steps[0].eliminations, ElementsAre(Elimination{6, 4, EliminationReason::Capping}));
  EXPECT_EQ(steps[0].marker, 'c');
  // Pair 1: two pairs at 2.5 and 0.01, less the 1 that was spent.
  EXPECT_THAT(race.wanted(), ElementsAre(RaceRun{1, 2, 4.01}));
}

TEST(CappedRace, MarksATaskThatOnlyElitesRan) {
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  RaceSettings settings = capped_race();
  settings.pairs_between_tests = 5;  // so that it does not stop before everything is even
  Race race(settings, {elite(1, {2, unknown, 2}), elite(2, {2, 2, 2}), {5, {}, {}}});
  answer(race, [](int) { return 2; });
  answer(race, [](int) { return 9; });
  EXPECT_THAT(race.wanted(), ElementsAre(RaceRun{2, 0, 10}));
  answer(race, [](int) { return 2; });
  std::string markers;
  for (const RaceStep& step : race.take_steps())
    markers += step.marker;
  EXPECT_EQ(markers.substr(0, 3), "c.:");
}

TEST(CappedRace, LeavesARejectedEliteOutOfTheBounds) {
  Race race(capped_race(), {elite(1, {2, 2, 2}), elite(2, {8, 8, 8}), {5, {}, {}}});
  race.tell(std::vector<Measurement>{{kRejects, 1}, {8, 8}});
  EXPECT_THAT(race.wanted(), ElementsAre(RaceRun{0, 2, 8.01}));
}

TEST(CappedRace, LetsCappingDecideWhereNonePassesBoth) {
  // The first is a little worse on five pairs and much better on the sixth: the signed ranks drop
  // it (p = 28/64), its mean drops the second.
  RaceSettings settings = capped_race();
  settings.new_pairs = settings.past_pairs = 0;
  settings.bound_max = 100;
  settings.test_type = TestType::FTest;
  settings.confidence = 0.1;
  settings.first_test = 6;
  settings.capping_after_first_test = true;
  Race race(settings, {{1, {}, {}}, {2, {}, {}}});
  const double first[] = {21, 21.1, 21.2, 21.3, 21.4, 10};
  while (!race.finished()) {
    std::vector<Measurement> answers;
    for (const RaceRun& run : race.wanted()) {
      const double time = run.column == 0 ? first[run.task] : 20;
      answers.push_back({time, time});
    }
    race.tell(answers);
  }
  const std::vector<RaceStep> steps = race.take_steps();
  ASSERT_EQ(steps.size(), 6U);
  EXPECT_EQ(steps[4].marker, 'x') << "nothing is dropped before the first test";
  EXPECT_EQ(steps[5].p_value, 28 / 64.0);
  EXPECT_THAT(steps[5].eliminations, ElementsAre(Elimination{2, 7, EliminationReason::Capping}));
}

TEST(CappedRace, FailsWhenATargetIgnoresItsBound) {
  Race race(capped_race(), {elite(1, {2, 2, 2}), {5, {}, {}}});
  answer(race, [](int) { return 2; });
  ASSERT_EQ(race.wanted().size(), 1U);
  EXPECT_EQ(race.wanted()[0].bound, 2.01);
  race.tell(std::vector<Measurement>{{2.5, 2.5}});
  EXPECT_TRUE(race.finished());
  ASSERT_TRUE(race.failure().has_value());
  EXPECT_THAT(race.failure()->message,
              HasSubstr("configuration 5 on pair 4 took 2.5, more than its bound of 2.01: "));
}

TEST(CappedRace, ToleratesWhatCannotBeMeasured) {
  Race race(capped_race(), {elite(1, {2, 2, 2}), {5, {}, {}}});
  answer(race, [](int) { return 2; });
  race.tell(std::vector<Measurement>{{2.015, 2.015}});
  EXPECT_FALSE(race.failure().has_value());
}

TEST(CappedRace, FailsWithoutTimes) {
  Race race(capped_race(), {elite(1, {2, 2, 2}), {5, {}, {}}});
  race.tell(std::vector<Measurement>{{2, 0}});
  ASSERT_TRUE(race.failure().has_value());
  EXPECT_THAT(race.failure()->message, HasSubstr("no time"));
}

TEST(BoundedRace, FailsWhenATargetIgnoresItsBound) {
  RaceSettings settings{.min_survival = 1, .max_experiments = 1000, .pairs = {1, 2, 3, 4, 5, 6}};
  for (const double bound : {0.0, 0.5, 1.0}) {
    settings.bound_max = bound;
    Race race(settings, {{1, {}, {}}, {2, {}, {}}, {3, {}, {}}});
    race.tell(std::vector<Measurement>(15, {4, 1.5}));
    EXPECT_EQ(race.failure().has_value(), bound > 0) << bound;
  }
}

TEST(BoundedRace, PassesOnTheLargestBoundAndTakesCostsAsTheyCome) {
  RaceSettings settings{.min_survival = 1, .max_experiments = 1000, .pairs = {1, 2, 3, 4, 5, 6}};
  settings.bound_max = 4;
  settings.bound_par = 10;
  Race race(settings, {{1, {}, {}}, {2, {}, {}}, {3, {}, {}}});
  ASSERT_EQ(race.wanted().size(), 15U);
  for (const RaceRun& run : race.wanted())
    EXPECT_EQ(run.bound, 4);
  race.tell(std::vector<Measurement>(15, {4, 0.001}));
  const std::vector<Race::Result> results = race.results(0);
  ASSERT_GE(results.size(), 5U);
  EXPECT_EQ(results[0].cost, 4);
  EXPECT_EQ(results[0].time, 0.01) << "raised to what can be measured";
}

}  // namespace
}  // namespace swarmsmith::irace
