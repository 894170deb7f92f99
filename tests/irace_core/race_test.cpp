#include "irace_core/internal/race.h"
#include "tests/irace_core/costs.h"
#include "tests/support/checks.h"

#include <cmath>
#include <limits>
#include <string>

namespace swarmsmith::irace {
namespace {

using ::testing::Key;

constexpr double kRejects = std::numeric_limits<double>::infinity();
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// A first race of `ids.size()` new configurations on 40 pairs.
RaceSettings first_race() {
  RaceSettings settings{.min_survival = 1, .max_experiments = 1000, .pairs = {}};
  for (std::int64_t pair = 1; pair <= 40; ++pair)
    settings.pairs.push_back(pair);
  return settings;
}

/// A later race: pair 4 is new, pairs 1 to 3 are past.
RaceSettings later_race() {
  RaceSettings settings = first_race();
  settings.pairs = {4, 1, 2, 3, 5, 6, 7, 8, 9, 10};
  settings.new_pairs = 1;
  settings.past_pairs = 3;
  return settings;
}

std::vector<Contestant> newcomers(std::int64_t count) {
  std::vector<Contestant> contestants;
  for (std::int64_t id = 1; id <= count; ++id)
    contestants.push_back({id, {}});
  return contestants;
}

/// Answers what is wanted; `cost` sees the configuration's id and the pair.
template <class Cost>
void answer(Race& race, Cost cost) {
  std::vector<double> costs;
  for (const RaceRun& run : race.wanted()) {
    costs.push_back(cost(race.contestant(run.column).id, race.pair_of(run.task)));
  }
  race.tell(testing::measured(costs));
}

/// Smaller ids are better on every pair.
double by_id(std::int64_t id, std::int64_t pair) {
  return static_cast<double>(10 * id) + static_cast<double>(pair % 3);
}

TEST(Race, AsksForEverythingUpToTheFirstTestAtOnce) {
  Race race(first_race(), newcomers(3));
  EXPECT_EQ(race.wanted().size(), 15U);  // three configurations, five pairs
  EXPECT_EQ(race.wanted()[0], (RaceRun{0, 0}));
  EXPECT_EQ(race.wanted()[3], (RaceRun{1, 0}));
}

TEST(Race, DropsTheWorseAtTheFirstTest) {
  // Ranks are 1 2 3 on all five pairs: S = 12 * 2 * 25 / (5*3*4) = 10, p = e^-5.
  Race race(first_race(), newcomers(3));
  answer(race, by_id);
  const std::vector<RaceStep> steps = race.take_steps();
  ASSERT_EQ(steps.size(), 5U);
  EXPECT_EQ(steps[3].marker, 'x');
  EXPECT_EQ(steps[4].marker, '-');
  EXPECT_NEAR(steps[4].statistic.value(), 10, 1e-12);
  EXPECT_NEAR(steps[4].p_value.value(), std::exp(-5.0), 1e-12);
  EXPECT_THAT(steps[4].eliminations, ElementsAre(Elimination{2, 10, EliminationReason::Test},
                                                 Elimination{3, 15, EliminationReason::Test}));
  EXPECT_EQ(steps[4].best, 1);
  EXPECT_EQ(race.stop_reason(), "configurations alive (1) <= those that survive (1)");
  EXPECT_EQ(race.used(), 15);
}

TEST(Race, KeepsElitesUntilTheyAreSeenOnNewInstances) {
  // The elite knows pairs 1 to 3 and is the worst of all; the first test comes while pair 3 of its
  // past still protects it.
  RaceSettings settings = later_race();
  settings.first_test = 3;
  Race race(settings, {{1, {90, 91, 92}}, {2, {}}, {3, {}}, {4, {}}});
  answer(race, [](std::int64_t id, std::int64_t pair) {
    return id == 1 ? 100.0 : static_cast<double>(id) + static_cast<double>(pair) / 8;
  });
  const std::vector<RaceStep> steps = race.take_steps();
  ASSERT_EQ(steps.size(), 3U);
  EXPECT_EQ(steps[2].marker, '-');
  for (const Elimination& elimination : steps[2].eliminations) {
    EXPECT_NE(elimination.configuration, 1);
  }
  EXPECT_EQ(race.wanted().front().task, 3U);
  for (const RaceRun& run : race.wanted())
    EXPECT_NE(run.column, 0U) << "knows that pair";
}

TEST(Race, MarksATestThatWouldOnlyHaveDroppedProtectedOnes) {
  RaceSettings settings = later_race();
  settings.first_test = 2;
  Race race(settings, {{1, {90, 91, 92}}, {2, {}}});
  answer(race, [](std::int64_t id, std::int64_t) { return id == 1 ? 100.0 : 1.0; });
  const std::vector<RaceStep> steps = race.take_steps();
  EXPECT_EQ(steps.back().marker, '!');
  EXPECT_THAT(steps.back().eliminations, IsEmpty());
  EXPECT_EQ(steps.back().alive_after, 2);
}

TEST(Race, RunsEliteOnPairsThatItMissed) {
  Race race(later_race(), {{1, {1, kUnknown, 1}}, {2, {}}, {3, {}}});
  std::vector<std::int64_t> pairs_of_elite;
  for (const RaceRun& run : race.wanted()) {
    if (run.column == 0) pairs_of_elite.push_back(race.pair_of(run.task));
  }
  EXPECT_THAT(pairs_of_elite, ElementsAre(4, 2, 5));  // the new one, the missed one, an unused one
}

TEST(Race, PassesOverPairsThatEverybodyAliveKnows) {
  RaceSettings settings = later_race();
  settings.first_test = 2;
  settings.min_survival = 2;
  Race race(settings, {{1, {1, 1, 1}}, {2, {2, 2, 2}}, {3, {}}, {4, {}}, {5, {}}});
  answer(race, by_id);
  std::vector<RaceStep> steps = race.take_steps();
  while (!race.finished()) {
    answer(race, by_id);
    for (RaceStep& step : race.take_steps())
      steps.push_back(std::move(step));
  }
  std::string markers;
  for (const RaceStep& step : steps)
    markers += step.marker;
  EXPECT_NE(markers.find('.'), std::string::npos) << markers;
  EXPECT_EQ(steps.back().alive_after, 2);
}

TEST(Race, RejectsAtOnceAndVoidsLaterRunsOfTheBatch) {
  Race race(first_race(), newcomers(4));
  ASSERT_EQ(race.wanted().size(), 20U);
  answer(race, [](std::int64_t id, std::int64_t pair) {
    return id == 2 && pair == 2 ? -kRejects : by_id(id, pair);
  });
  const std::vector<RaceStep> steps = race.take_steps();
  EXPECT_THAT(steps[1].eliminations, ElementsAre(Elimination{2, 0, EliminationReason::Rejection}));
  EXPECT_THAT(steps[1].evaluated, ElementsAre(Key(1), Key(2), Key(3), Key(4)));
  EXPECT_THAT(steps[2].evaluated, ElementsAre(Key(1), Key(3), Key(4)));
  EXPECT_EQ(race.used(), 17);  // 4 + 4 + 3 + 3 + 3
  EXPECT_TRUE(race.is_rejected(1));
}

TEST(Race, IgnoresWhatVoidRunsCost) {
  std::vector<std::uint64_t> digests[2];
  for (const int version : {0, 1}) {
    Race race(first_race(), newcomers(5));
    while (!race.finished()) {
      answer(race, [&](std::int64_t id, std::int64_t pair) {
        if (id == 4 && pair >= 2) return pair == 2 ? kRejects : version * 1e6 - 1000.0;
        return static_cast<double>((3 * id + 7 * pair) % 11);
      });
    }
    for (const RaceStep& step : race.take_steps())
      digests[version].push_back(step.digest);
  }
  EXPECT_EQ(digests[0], digests[1]);
}

TEST(Race, TestsOnlyEverySecondPairWhenAskedTo) {
  RaceSettings settings = first_race();
  settings.first_test = 4;
  settings.pairs_between_tests = 2;
  settings.elitist_limit = 3;
  Race race(settings, newcomers(4));
  while (!race.finished()) {
    answer(race,
           [](std::int64_t id, std::int64_t pair) { return static_cast<double>((id + pair) % 4); });
  }
  std::string markers;
  for (const RaceStep& step : race.take_steps())
    markers += step.marker;
  EXPECT_EQ(markers, "xxx=x=x=x=");
}

TEST(Race, DecidesBetweenTwoByTheirSigns) {
  // Two configurations: one that is never worse wins at the first test.
  Race race(first_race(), newcomers(2));
  answer(race, by_id);
  const std::vector<RaceStep> steps = race.take_steps();
  EXPECT_EQ(steps.back().marker, '-');
  EXPECT_EQ(steps.back().p_value, 0);
  EXPECT_EQ(race.contestant(race.survivors().front().column).id, 1);
}

TEST(Race, StopsWhenThePairsRunOut) {
  RaceSettings settings = first_race();
  settings.pairs.resize(6);
  settings.elitist_limit = 0;
  Race race(settings, newcomers(4));
  while (!race.finished()) {
    answer(race,
           [](std::int64_t id, std::int64_t pair) { return static_cast<double>((id + pair) % 4); });
  }
  EXPECT_EQ(race.stop_reason(), "no pairs left");
  EXPECT_EQ(race.used(), 24);
}

TEST(Race, StopsWhereRejectionsLeaveTooFew) {
  RaceSettings settings = first_race();
  settings.min_survival = 2;
  Race race(settings, newcomers(3));
  answer(race, [](std::int64_t id, std::int64_t) { return id == 3 ? kRejects : 1.0; });
  EXPECT_TRUE(race.finished());
  EXPECT_EQ(race.used(), 3);  // what was wanted after the first pair is void
  EXPECT_EQ(race.survivors().size(), 2U);
}

TEST(Race, EndsWithNoneWhenAllAreRejected) {
  Race race(first_race(), newcomers(3));
  answer(race, [](std::int64_t, std::int64_t) { return kRejects; });
  EXPECT_TRUE(race.finished());
  EXPECT_EQ(race.stop_reason(), "all configurations were rejected");
  EXPECT_TRUE(race.none_left());
  EXPECT_THAT(race.survivors(), IsEmpty());
  EXPECT_THAT(race.alive_ids(), IsEmpty());
  const std::vector<RaceStep> steps = race.take_steps();
  ASSERT_EQ(steps.size(), 1U);
  EXPECT_EQ(steps[0].experiments_used, 3);
  EXPECT_EQ(steps[0].eliminations.size(), 3U);
}

TEST(Race, EndsAfterTestsThatDropNone) {
  RaceSettings settings = first_race();
  settings.elitist_limit = 2;
  Race race(settings, newcomers(4));
  const auto alternating = [](std::int64_t id, std::int64_t pair) {
    return static_cast<double>((id + pair) % 4);  // a Latin square: none is better
  };
  while (!race.finished())
    answer(race, alternating);
  EXPECT_EQ(race.take_steps().size(), 7U);  // first test on 5, then two in vain on 6 and 7
  EXPECT_EQ(race.used(), 28);
  EXPECT_EQ(race.stop_reason(), "tests without elimination (2) >= limit (2)");
}

TEST(Race, EndsBeforeATestThatItCannotPay) {
  RaceSettings settings = first_race();
  settings.elitist_limit = 0;
  const auto ended = [&](std::int64_t budget_of_the_race, std::int64_t left) {
    settings.max_experiments = budget_of_the_race;
    settings.experiments_left = left;
    Race race(settings, newcomers(4));
    while (!race.finished()) {
      answer(race, [](std::int64_t id, std::int64_t pair) {
        return static_cast<double>((id + pair) % 4);
      });
    }
    return std::to_string(race.used()) + ": " + race.stop_reason();
  };
  EXPECT_EQ(ended(27, 1000), "24: experiments up to the next test (28) > budget of the race (27)");
  EXPECT_EQ(ended(28, 1000), "28: experiments up to the next test (32) > budget of the race (28)");
  EXPECT_EQ(ended(1000, 27), "24: experiments of the next task (28) > budget that is left (27)");
  EXPECT_EQ(ended(1000, 28), "28: experiments of the next task (32) > budget that is left (28)");
  EXPECT_EQ(ended(1000, 19), "16: experiments of the next task (20) > budget that is left (19)")
      << "before the first test, too";
}

TEST(Race, ReportsResultsOfThisRaceOnly) {
  RaceSettings settings = later_race();
  settings.elitist_limit = 1;
  Race race(settings, {{1, {1, kUnknown, 1}}, {2, {}}, {3, {}}});
  while (!race.finished())
    answer(race, by_id);
  std::vector<std::int64_t> pairs;
  for (const Race::Result& result : race.results(0))
    pairs.push_back(result.pair);
  ASSERT_GE(pairs.size(), 2U);
  EXPECT_EQ(pairs[0], 4);
  EXPECT_EQ(pairs[1], 2);
  for (const std::int64_t pair : pairs)
    EXPECT_TRUE(pair != 1 && pair != 3) << pair;
}

}  // namespace
}  // namespace swarmsmith::irace
