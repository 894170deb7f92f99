#include <array>
#include <memory>
#include <utility>

#include "irace_core/search/halving.h"
#include "irace_core/search/search_loop.h"
#include "sim/control/conditions/obstacle_ahead.h"
#include "sim/mission/arena.h"
#include "sim/mission/scores/spread.h"
#include "tests/irace_core/search/played.h"
#include "tests/sim/control/fake_senses.h"
#include "tests/support/checks.h"

// The files that the pages show, compiled as they stand there. Whether the whole program knows them
// after their line is programs_test.py's to say, which compiles it.

namespace swarmsmith {
namespace {

TEST(HowTo, TheConditionOfFlavoursIsEnabledByAnObstacle) {
  const ObstacleAhead condition{.probability = 0.4};
  FakeSenses senses;
  const auto enabled = [&] {
    return condition.enabling(ObstacleAhead::Reads::of(senses), chocolate());
  };
  EXPECT_EQ(enabled(), 0);
  senses.obstacle(0, 0.19);
  EXPECT_EQ(enabled(), 0.4);
  senses.obstacle(0, 0.41);
  EXPECT_EQ(enabled(), 0);
  EXPECT_EQ(senses.asked(), senses.proximity_asked);
  EXPECT_TRUE(ObstacleAhead::Reads::kUses == UsedSenses{.proximity = true});
}

TEST(HowTo, TheSearchOfMethodsKeepsToItsBudgetAndFindsTheSphere) {
  Scenario scenario;
  scenario.max_experiments = 12'000;
  scenario.seed = 3;
  auto space = std::make_unique<ParameterSpace>(weights_space(4));
  auto strategy = value_of(HalvingOptions{}.start(
      {.space = *space, .scenario = scenario, .initial = {}, .repair = {}, .neighbourhood = {}}));
  auto search =
      value_of(search::SearchLoop::start(std::move(space), scenario, std::move(strategy)));
  const Played played = play(*search, noisy_sphere);
  EXPECT_LE(search->experiments_used(), scenario.max_experiments);
  EXPECT_EQ(search->experiments_used(), played.asked);
  const Configuration& best = search->configuration(played.elites.front().configuration);
  double distance = 0;
  for (std::size_t i = 0; i < best.size(); ++i)
    distance += (best[i] - 1) * (best[i] - 1);
  EXPECT_LT(distance, 9) << "a uniform draw is 37 away from it in the mean";
}

TEST(HowTo, TheSearchOfMethodsSaysWhichBudgetWorks) {
  Scenario scenario;
  scenario.max_experiments = 9;
  const ParameterSpace space = weights_space(2);
  EXPECT_THAT(why_not(HalvingOptions{}.start({.space = space,
                                              .scenario = scenario,
                                              .initial = {},
                                              .repair = {},
                                              .neighbourhood = {}}))
                  .message,
              HasSubstr("must be at least 10"));
}

TEST(HowTo, TheScoreOfMissionsMeasuresDistances) {
  // Distances 0.5 and 1.5: greatest sides of the triangles 3-4-5 and 9-12-15.
  const std::array<Point, 3> first = {Point{0, 0}, Point{0.3, 0}, Point{0.3, 0.4}};
  const std::array<Point, 3> last = {Point{0, 0}, Point{0.9, 0}, Point{0.9, 1.2}};
  const Arena arena = dodecagon_of_the_thesis();
  const auto score = [&](When at) {
    SpreadScorer scorer(Spread{.free_m = 0.25, .at = at}, arena);
    scorer.observe({.robots = first, .objects = {}});
    scorer.observe({.robots = last, .objects = {}});
    return scorer.score();
  };
  EXPECT_EQ(score(When::End), -1.25);
  EXPECT_EQ(score(When::Sum), -1.5);
}

}  // namespace
}  // namespace swarmsmith
