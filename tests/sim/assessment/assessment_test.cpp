#include "sim/assessment/assessment.h"
#include "sim/files/profile_file.h"
#include "sim/files/robot_file.h"
#include "tests/support/checks.h"

#include <map>
#include <utility>

namespace swarmsmith::assessment {
namespace {

Report assessed(const char* flavour, const char* profile) {
  return assess({**find_flavour(flavour), *built_in_profile(profile), rvr()});
}

/// Ids of the modules that fail.
std::vector<std::string> failing(const Report& report) {
  std::vector<std::string> ids;
  for (const ModuleReport& module : report.modules) {
    if (!module.passes()) ids.emplace_back(id_of(module.module));
  }
  return ids;
}

const ModuleReport& module_in(const Report& report, Module module) {
  return *std::ranges::find(report.modules, module, &ModuleReport::module);
}

TEST(Assessment, AllModulesOfTheThesisPassWithItsNoise) {
  const Report report = assessed("watermelon", "rvr");
  EXPECT_EQ(report.modules.size(), 11U);
  EXPECT_THAT(failing(report), IsEmpty());
  EXPECT_EQ(report.passed(), 11);
  EXPECT_TRUE(report.passes());
}

TEST(Assessment, AllModulesOfTheThesisPassWithoutNoise) {
  const Report report = assessed("watermelon", "argos3");
  EXPECT_THAT(failing(report), IsEmpty());
  // Nothing to explain without noise.
  for (const ModuleReport& module : report.modules) {
    for (const Check& check : module.checks)
      EXPECT_EQ(check.note, "") << id_of(module.module);
  }
}

TEST(Assessment, AllModulesOfChocolatePass) {
  const Report report = assessed("chocolate", "rvr");
  EXPECT_EQ(report.modules.size(), 12U);
  EXPECT_THAT(failing(report), IsEmpty());
}

// The published program counts centimetres: 1.2 x 3 / (1 + 50) = 0.07 is too short a vector to be
// followed, and nearer the neighbour is an obstacle. Its Attraction gathers no robot.
TEST(Assessment, TheAttractionOfThePublishedProgramFails) {
  const Report report = assessed("watermelon-argos3", "argos3");
  EXPECT_THAT(failing(report), ElementsAre("attraction"));
  EXPECT_EQ(report.passed(), 10);
  EXPECT_FALSE(report.passes());
  EXPECT_THAT(module_in(report, Module::Attraction).checks.at(0).note,
              HasSubstr("went straight ahead in "));
}

// Each channel of the black spot reads 0 with probability P(N(0, 5) < 0.5) = 0.54, all three with
// 0.157; red reads as a hue near 360 in half of the rest.
TEST(Assessment, TellsWhatGroundNoiseDoesToTheThresholdsOfThePublishedProgram) {
  const Report report = assessed("watermelon-argos3", "rvr");
  const Check& black = module_in(report, Module::BlackFloor).checks.at(0);
  EXPECT_TRUE(black.passes);
  EXPECT_THAT(black.note, HasSubstr("the reading satisfied it in "));
  EXPECT_THAT(module_in(report, Module::GrayFloor).checks.at(0).note,
              HasSubstr("were over other floor, which the ground sensor misread"));
}

// The same of a robot that is a disc, senses strengths, votes on the floor and hears of others.
TEST(Assessment, AllModulesOfTheEPuckPass) {
  const Robot epuck = find_robot("epuck", {}).value();
  for (const char* flavour : {"chocolate-epuck", "chocolate-epuck-2018"}) {
    for (const char* profile : {"epuck", "epuck-ideal"}) {
      const Report report = assess({**find_flavour(flavour), *built_in_profile(profile), epuck});
      EXPECT_EQ(report.modules.size(), 12U);
      EXPECT_THAT(failing(report), IsEmpty()) << flavour << " " << profile;
    }
  }
}

// Its robots turn where a reading is above 0.5, the others' above 0.1: so near to walls that they
// scrape along them.
TEST(Assessment, TheExplorationOfMapleOf2020TouchesTooMuch) {
  const Robot epuck = find_robot("epuck", {}).value();
  const Report report = assess({**find_flavour("maple-epuck"), *built_in_profile("epuck"), epuck});
  EXPECT_THAT(failing(report), ElementsAre("exploration"));
}

TEST(Assessment, HasRoomForRobotsUpToHalfAMetre) {
  EXPECT_EQ(too_big(rvr()), std::nullopt);
  EXPECT_EQ(too_big(rvr_with(CircleOutline{0.249})), std::nullopt);
  EXPECT_THAT(too_big(rvr_with(CircleOutline{0.25})).value_or(""),
              HasSubstr("reaches 0.25 m from its middle"));
  Robot blind = rvr();
  blind.neighbours.range_m = 0;
  EXPECT_EQ(too_big(blind), std::nullopt);
  blind.neighbours.range_m = 0.1;
  EXPECT_NE(too_big(blind), std::nullopt);
}

// Repulsion seems to pass, because robots that see no one drift apart; with eta = 0 the counts of
// neighbours do not matter.
TEST(Assessment, NoModuleThatUsesNeighboursPassesWithoutAny) {
  Robot blind = rvr();
  blind.neighbours.range_m = 0;
  const Report report = assess({watermelon(), *built_in_profile("argos3"), blind});
  EXPECT_THAT(failing(report), ElementsAre("attraction", "repulsion", "neighbour_count",
                                           "inverted_neighbour_count"));
  for (const ModuleReport& module : report.modules) {
    EXPECT_EQ(module.checks.at(0).note, module.passes() ? "" : "no robot ever saw a neighbour")
        << id_of(module.module);
  }
}

TEST(Assessment, RunsEachBehaviourFiveAndEachConditionTenTimes) {
  const Report report = assessed("watermelon", "argos3");
  for (const ModuleReport& module : report.modules) {
    const bool behaviour =
        watermelon().behaviours.size() > static_cast<std::size_t>(&module - report.modules.data());
    const bool counts =
        module.module == Module::NeighbourCount || module.module == Module::InvertedNeighbourCount;
    for (const Check& check : module.checks) {
      EXPECT_EQ(check.runs, behaviour ? 5 : 10) << id_of(module.module);
      EXPECT_EQ(check.values.size(), behaviour ? 5U : counts ? 30U : 10U) << id_of(module.module);
    }
  }
  EXPECT_EQ(module_in(report, Module::ColorDetection).checks.size(), 4U);
}

TEST(Assessment, MeasuresTheRatesThatTheParametersPromise) {
  const Report report = assessed("watermelon", "rvr");
  // Eq. 5.7 with eta = 5, xi = 1: z(0) = 1 / (1 + e^5), z(2) = 1 - z(0).
  const std::vector<double> z = {0.0066928509, 0.5, 0.9933071491};
  for (const ModuleReport& module : report.modules) {
    for (std::size_t i = 0; i < module.rates.size(); ++i) {
      const Rate& rate = module.rates[i];
      const bool count = module.module == Module::NeighbourCount;
      const bool inverted = module.module == Module::InvertedNeighbourCount;
      EXPECT_NEAR(rate.expected, count ? z[i] : inverted ? 1 - z[i] : 0.3, 1e-9);
      EXPECT_GT(rate.trials, 1000) << id_of(module.module) << " " << rate.setting;
      EXPECT_LE(rate.low, rate.expected) << id_of(module.module) << " " << rate.setting;
      EXPECT_GE(rate.high, rate.expected) << id_of(module.module) << " " << rate.setting;
    }
  }
  EXPECT_EQ(module_in(report, Module::NeighbourCount).rates.size(), 3U);
  EXPECT_THAT(module_in(report, Module::Stop).rates, IsEmpty());
}

TEST(Assessment, TellsItsProgressModuleByModule) {
  std::vector<std::pair<int, int>> told;
  Flavour two = watermelon();
  two.behaviours.resize(1);
  two.conditions.resize(1);
  assess({two, *built_in_profile("argos3"), rvr()},
         [&](int done, int of) { told.emplace_back(done, of); });
  EXPECT_THAT(told, ElementsAre(std::pair(1, 2), std::pair(2, 2)));
}

// A drifting control clock must not look like a condition that fires without a reason.
TEST(Assessment, TestsConditionsOnANominalClock) {
  Profile drifting = *built_in_profile("argos3");
  drifting.timing.least_period = 0.75;
  drifting.timing.jitter = 0.05;
  Flavour conditions = watermelon();
  conditions.behaviours.clear();
  EXPECT_THAT(failing(assess({conditions, drifting, rvr()})), IsEmpty());
  drifting.timing.jitter = 0;
  drifting.ranges.push_back({.field = "timing.jitter", .least = 0.04, .most = 0.05});
  EXPECT_THAT(failing(assess({conditions, drifting, rvr()})), IsEmpty()) << "drawn for each robot";
}

}  // namespace
}  // namespace swarmsmith::assessment
