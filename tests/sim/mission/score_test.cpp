#include "sim/mission/score.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "sim/mission/mission.h"
#include "tests/sim/mission/score_support.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

/// Scorer of a built-in mission on its instance of seed 1.
Scorer scorer_of(const std::string& name) {
  const Mission mission = built_in_mission(name).value();
  return Scorer(mission.rule, arena_of(mission, instance_of(mission, 1).value()));
}

// --- What holds for the score of every mission ---------------------------------------------------

class EveryMission : public ::testing::TestWithParam<const char*> {};

TEST_P(EveryMission, ScoresNothingAsZero) {
  EXPECT_EQ(scorer_of(GetParam()).score(), 0);
}

TEST_P(EveryMission, DoesNotDependOnTheOrderOfTheRobots) {
  const auto walks = random_walks(200);
  auto turned = walks;
  for (std::size_t i = 0; i < turned.size(); ++i) {
    std::rotate(turned[i].begin(), turned[i].begin() + 1 + static_cast<int>(i % 2),
                turned[i].end());
  }
  EXPECT_EQ(score_after(scorer_of(GetParam()), walks), score_after(scorer_of(GetParam()), turned));
}

TEST_P(EveryMission, CanBeAskedAtAnyInstantAndGoOn) {
  const auto walks = random_walks(100);
  Scorer asked = scorer_of(GetParam());
  for (const auto& robots : walks) {
    asked.observe(robots);
    EXPECT_EQ(asked.score(), asked.score());
  }
  EXPECT_EQ(asked.score(), score_after(scorer_of(GetParam()), walks));
}

TEST_P(EveryMission, BearsAnEmptyArenaAndRobotsFarAway) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  Scorer scorer = scorer_of(GetParam());
  scorer.observe({});
  for (const Point point : {Point{1e300, -1e300}, Point{infinity, 0}, Point{nan, nan},
                            Point{-1.250006, 0}, Point{1.25, 1.26}}) {
    scorer.observe(std::vector<Point>{point});
  }
  EXPECT_LE(scorer.score(), 0);
}

TEST_P(EveryMission, GivesACopyALifeOfItsOwn) {
  const auto walks = random_walks(50);
  Scorer scorer = scorer_of(GetParam());
  scorer.observe(walks[0]);
  const double before = scorer.score();
  Scorer copy = scorer;
  for (const auto& robots : walks)
    copy.observe(robots);
  EXPECT_EQ(scorer.score(), before);
}

INSTANTIATE_TEST_SUITE_P(BuiltIn, EveryMission,
                         ::testing::Values("aggregation", "grid_exploration", "color_selection"));

// --- Aggregation ---------------------------------------------------------------------------------

TEST(RobotsOn, CountsThoseOnTheColorAtTheEnd) {
  const Scorer scorer = scorer_of("aggregation");
  EXPECT_EQ(score_after(scorer, {{{0, 0}, {0.5, 0}, {0.51, 0}}}), 2);
  EXPECT_EQ(score_after(scorer, {{{0, 0}, {0.1, 0}, {0.2, 0}}, {{1, 0}, {1, 0}, {0, 0.2}}}), 1);
}

TEST(RobotsOn, SumsRobotCycles) {
  const Scorer scorer(RobotsOn{.color = {0, 0, 0}, .at = When::Sum}, some_arena());
  EXPECT_EQ(score_after(scorer, {{{0, 0}, {0.1, 0}, {9, 0}}, {{0, 0}, {9, 0}, {9, 0}}, {}}), 3);
}

TEST(ObjectsOn, CountsObjectsAndNoRobots) {
  Scorer at_end(ObjectsOn{.color = {0, 0, 0}, .at = When::End}, some_arena());
  Scorer summed(ObjectsOn{.color = {0, 0, 0}, .at = When::Sum}, some_arena());
  const std::vector<Point> robots(5);
  for (const double x : {0.7, 0.6, 0.0}) {
    const std::vector<Point> objects = {{x, 0}, {0, 0.61}, {0.2, 0.2}};
    at_end.observe(robots, objects);
    summed.observe(robots, objects);
  }
  EXPECT_EQ(at_end.score(), 2);
  EXPECT_EQ(summed.score(), 1 + 2 + 2);
  at_end.observe(robots);
  EXPECT_EQ(at_end.score(), 0);
}

TEST(MostOn, CountsTheFullestSpot) {
  Arena arena;
  arena.patches = {{Disc{{0, 0}, 0.5}, {0, 0, 0}},
                   {Disc{{2, 0}, 0.5}, {0, 0, 0}},
                   {Disc{{4, 0}, 0.5}, {255, 255, 255}}};
  const std::vector<std::vector<Point>> walk = {{{0, 0}, {0.1, 0}, {2, 0}, {4, 0}, {4, 0}},
                                                {{0, 0}, {2, 0}, {2, 0.5}, {2, 0.1}, {4, 0}}};
  EXPECT_EQ(score_after(Scorer(MostOn{.color = {0, 0, 0}}, arena), walk), 3);
  EXPECT_EQ(score_after(Scorer(MostOn{.color = {0, 0, 0}, .at = When::Sum}, arena), walk), 5);
  EXPECT_EQ(score_after(Scorer(MostOn{.color = {0, 0, 0}, .share = true}, arena), walk), 0.6);
}

// --- Grid exploration ----------------------------------------------------------------------------

TEST(Coverage, ThreeRobotsThatStandOnTilesOfTheirOwnCost697818) {
  const std::vector<Point> robots = {{-0.9, 0.1}, {0.1, 0.1}, {0.6, -0.4}};
  EXPECT_EQ(score_after(scorer_of("grid_exploration"), {1200, robots}), -697818);
}

TEST(Coverage, TwoRobotsOnOneTileCountOnce) {
  const std::vector<Point> robots = {{0.05, 0.1}, {0.1, 0.1}, {0.6, -0.4}};
  EXPECT_EQ(score_after(scorer_of("grid_exploration"), {1200, robots}), -7194.0 * 98);
}

/// The definition, counter by counter (rvr-automode facts, section 8).
double cost_by_counters(const std::vector<std::vector<Point>>& instants, int tiles, double side_m) {
  std::vector<int> counters(static_cast<std::size_t>(tiles * tiles));
  double total = 0;
  for (const auto& robots : instants) {
    for (const Point robot : robots) {
      const int column = static_cast<int>(std::floor(tiles * (robot.x / side_m + 0.5)));
      const int row = static_cast<int>(std::floor(tiles * (robot.y / side_m + 0.5)));
      counters[static_cast<std::size_t>(row * tiles + column)] = 0;
    }
    for (int& counter : counters)
      total += counter++;
  }
  return total / (tiles * tiles);
}

TEST(Coverage, AgreesWithAHundredCounters) {
  const auto walks = random_walks(1200);
  EXPECT_NEAR(score_after(scorer_of("grid_exploration"), walks),
              -cost_by_counters(walks, 10, 2.50001), 1e-9);
  const Scorer coarse(Coverage{.tiles = 3, .side_m = 3}, Arena{.walls = {}, .patches = {}});
  EXPECT_NEAR(score_after(coarse, walks), -cost_by_counters(walks, 3, 3), 1e-9);
}

TEST(Coverage, WorkedOutByHandOnFourTiles) {
  // Ages at the instants 1, 2, 3. Visited at 1: 0 1 2. Visited at 2: 0 0 1. Never: 0 1 2 twice.
  const Scorer scorer(Coverage{.tiles = 2, .side_m = 2}, Arena{.walls = {}, .patches = {}});
  EXPECT_EQ(score_after(scorer, {{{-0.5, -0.5}}, {{0.5, -0.5}}, {}}), -(3 + 1 + 3 + 3) / 4.0);
}

TEST(Coverage, NeedsTilesAndASide) {
  const Arena arena{.walls = {}, .patches = {}};
  EXPECT_THROW(Scorer(Coverage{.tiles = 0, .side_m = 1}, arena), std::invalid_argument);
  EXPECT_THROW(Scorer(Coverage{.tiles = 2, .side_m = 0}, arena), std::invalid_argument);
}

// --- Colour selection ----------------------------------------------------------------------------

TEST(ColorReward, SumsTheRewardsOfTheColorsUnderTheRobots) {
  const Mission mission = built_in_mission("color_selection").value();
  const Instance instance{.starts = {},
                          .patches = {{Rectangle{{0.25, 0.25}, 0.30, 0.30}, {0, 255, 0}},
                                      {Rectangle{{-0.25, 0.25}, 0.30, 0.30}, {255, 0, 0}},
                                      {Rectangle{{-0.25, -0.25}, 0.30, 0.30}, {255, 255, 0}}}};
  const Scorer scorer(mission.rule, arena_of(mission, instance));
  const Point green{0.3, 0.3};
  const Point red{-0.3, 0.3};
  const Point yellow{-0.3, -0.3};
  EXPECT_EQ(score_after(scorer, {{green, red, yellow}}), 3);
  EXPECT_EQ(score_after(scorer, {{yellow, yellow, yellow}}), 6);
  EXPECT_EQ(score_after(scorer, {{{0, 0}, {1, 1}, green}}), 0);
  EXPECT_EQ(score_after(scorer, {{yellow, yellow, yellow}, {red, green, {0, 0}}}), 1);
}

TEST(ColorReward, SumsTheRewardsOfAllCycles) {
  const ColorReward rule{.rewards = {{{0, 0, 0}, 0.25}, {{127, 127, 127}, -2}}, .at = When::Sum};
  const Scorer scorer(rule, some_arena());
  EXPECT_EQ(score_after(scorer, {{{0, 0}, {0.1, 0}, {9, 0}}, {{0, 0}, {0, 0}, {0, 0}}}),
            5 * 0.25 - 2);
}

TEST(ColorReward, NeedsEachColorOnceAndFiniteRewards) {
  const Arena arena = some_arena();
  EXPECT_THROW(Scorer(ColorReward{}, arena), std::invalid_argument);
  const ColorReward twice{.rewards = {{{1, 1, 1}, 1}, {{1, 1, 1}, 2}}};
  EXPECT_THROW(Scorer(twice, arena), std::invalid_argument);
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THROW(Scorer(ColorReward{.rewards = {{{1, 1, 1}, infinity}}}, arena),
               std::invalid_argument);
}

// --- Foraging ------------------------------------------------------------------------------------

/// A black source on the left, a white nest on the right, grey between.
Arena source_and_nest() {
  return {.walls = {},
          .patches = {{Disc{{-1, 0}, 0.3}, {0, 0, 0}}, {Disc{{1, 0}, 0.3}, {255, 255, 255}}}};
}

constexpr Point kSource{-1, 0};
constexpr Point kBetween{0, 0};
constexpr Point kNest{1, 0};

TEST(Foraging, CountsWhatIsBroughtToTheNest) {
  const Scorer scorer(Foraging{}, source_and_nest());
  EXPECT_EQ(score_after(scorer, {{kSource}, {kBetween}, {kNest}}), 1);
  EXPECT_EQ(score_after(scorer, {{kSource}, {kNest}, {kSource}, {kNest}}), 2);
}

TEST(Foraging, CarriesOneItemAtATime) {
  const Scorer scorer(Foraging{}, source_and_nest());
  EXPECT_EQ(score_after(scorer, {{kSource}, {kSource}, {kBetween}, {kSource}, {kNest}, {kNest}}),
            1);
}

TEST(Foraging, NeedsASourceFirst) {
  const Scorer scorer(Foraging{}, source_and_nest());
  EXPECT_EQ(score_after(scorer, {{kNest}, {kBetween}, {kNest}, {kSource}}), 0);
}

TEST(Foraging, LetsNoRobotDeliverForAnother) {
  const Scorer scorer(Foraging{}, source_and_nest());
  EXPECT_EQ(score_after(scorer, {{kSource, kNest}, {kBetween, kNest}}), 0);
  EXPECT_EQ(score_after(scorer, {{kSource, kNest}, {kNest, kSource}, {kNest, kNest}}), 2);
}

TEST(Foraging, NeedsTwoColors) {
  const auto fault = value_of(fault_of(Foraging{.nest = {1, 2, 3}, .source = {1, 2, 3}}));
  EXPECT_EQ(fault.where, "source");
}

// --- Formulas ---------------------------------------------------------------------------------

double formula_score(const Formula& rule, const std::vector<std::vector<Point>>& instants) {
  return score_after(Scorer(rule, source_and_nest()), instants);
}

TEST(FormulaScore, SaysTheSameAsTheKindsThatAreBuiltIn) {
  const auto walks = random_walks(200);
  for (const When at : {When::End, When::Sum}) {
    EXPECT_EQ(score_after(Scorer(Formula{.value = "black", .at = at}, some_arena()), walks),
              score_after(Scorer(RobotsOn{.color = {0, 0, 0}, .at = at}, some_arena()), walks));
  }
  Scorer objects(Formula{.value = "black", .of = "objects"}, some_arena());
  objects.observe({}, std::vector<Point>{{0, 0}, {0.1, 0}, {3, 3}});
  EXPECT_EQ(objects.score(), 2);
}

TEST(FormulaScore, PutsTheRobotsTogether) {
  const std::vector<std::vector<Point>> robots = {{{-2, 0}, {1, 0}, {4, 0}}};
  EXPECT_EQ(formula_score({.value = "x", .over = "sum"}, robots), 3);
  EXPECT_EQ(formula_score({.value = "x", .over = "mean"}, robots), 1);
  EXPECT_EQ(formula_score({.value = "x", .over = "min"}, robots), -2);
  EXPECT_EQ(formula_score({.value = "x", .over = "max"}, robots), 4);
}

TEST(FormulaScore, KnowsTimeSpeedAndDistances) {
  const std::vector<std::vector<Point>> robots = {{{0, 0}, {0, 4}}, {{0.3, 0}, {0.3, 4}}};
  EXPECT_EQ(formula_score({.value = "t", .over = "max"}, robots), 0.2);
  EXPECT_EQ(formula_score({.value = "t", .over = "max", .at = When::Sum}, robots), 0.1 + 0.2);
  EXPECT_DOUBLE_EQ(formula_score({.value = "speed", .over = "max"}, robots), 3);
  EXPECT_DOUBLE_EQ(formula_score({.value = "speed", .at = When::Sum}, robots), 6);
  EXPECT_EQ(formula_score({.value = "nearest", .over = "max"}, robots), 4);
  EXPECT_EQ(formula_score({.value = "from_centre", .over = "max"}, robots), 2);
  EXPECT_EQ(formula_score({.value = "nearest"}, {{{1, 1}}}), 0) << "a robot alone";
}

TEST(FormulaScore, OfTheSwarmSeesItAsAWhole) {
  const std::vector<std::vector<Point>> robots = {{kSource, {-1.1, 0}, kNest}};
  EXPECT_EQ(formula_score({.value = "min(black, white)", .of = "swarm"}, robots), 1);
  EXPECT_EQ(formula_score({.value = "black == 2 && robots == 3 ? 7 : 0", .of = "swarm"}, robots),
            7);
  EXPECT_EQ(formula_score({.value = "!green + !(black != 2)", .of = "swarm"}, robots), 2);
  EXPECT_DOUBLE_EQ(formula_score({.value = "-spread", .of = "swarm"}, robots), -2.1);
  EXPECT_EQ(formula_score({.value = "x", .of = "swarm"}, {{{1, 0}, {3, 0}}}), 2);
}

TEST(FormulaScore, SaysWhatIsWrongAndWhere) {
  const auto message = [](const std::string& value, const std::string& of = "robots") {
    const auto fault = fault_of(Formula{.value = value, .of = of});
    return fault ? fault->message : "nothing";
  };
  EXPECT_EQ(
      message("2 * distance"),
      "the score's `value` cannot be computed: at character 5: there is no `distance`; "
      "names are x, y, t, speed, nearest, from_centre, black, gray, white, red, green, blue, "
      "yellow; functions are abs, sqrt, min, max, floor, hypot, exp, log, pow, sin, cos, atan2");
  EXPECT_THAT(message("blak"), HasSubstr("did you mean \"black\"?"));
  EXPECT_THAT(message("-spread"), EndsWith("; with of = \"swarm\" it could be"));
  EXPECT_THAT(message("nearest", "swarm"), EndsWith("with of = \"robots\" it could be"));
  EXPECT_THAT(message("x)"), EndsWith("at character 2: `)` is not allowed here"));
  EXPECT_THAT(message("atan2(x)"), EndsWith("`atan2` needs more values"));
  EXPECT_THAT(message(""), EndsWith("it is empty"));
  EXPECT_EQ(message("x ^ 2"),
            "the score's `value` cannot be computed: at character 3: there is no `^`; write x * x, "
            "or pow(x, 3)");
  for (const std::string wrong :
       {"",       " ",          "(x",  "x)",       "x +",     "x = 3", "x, y",   "\"x\"",
        "sqrt()", "sqrt(x, y)", "x y", "nearest(", "rint(x)", "_pi",   "x +* y", "min()",
        "sum(x)", "0x",         "x;y", "x\ny",     "x ? y",   "é"}) {
    EXPECT_NE(message(wrong), "nothing") << wrong;
  }
  EXPECT_NE(message(std::string(1001, '-') + "x"), "nothing");
  EXPECT_NE(message("nearest", "swarm"), "nothing");
  EXPECT_NE(message("x", "all"), "nothing");
  EXPECT_EQ(message(std::string(400, '(') + "x" + std::string(400, ')')), "nothing");
}

TEST(FormulaScore, ThatIsNoNumberStaysNoNumber) {
  EXPECT_TRUE(std::isnan(formula_score({.value = "0 / (x - x)"}, {{kNest, kSource}})));
  EXPECT_TRUE(std::isnan(formula_score({.value = "sqrt(x)", .over = "max"}, {{kNest, kSource}})));
}

}  // namespace
}  // namespace swarmsmith
