#include <gmock/gmock.h>

#include <stdexcept>

#include "sim/assessment/assessment.h"
#include "sim/files/profile_file.h"

// A flavour with one wrong number fails in the module that uses it, and in no other.

namespace swarmsmith::assessment {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

struct Failures {
  std::vector<std::string> modules;
  std::string notes;
};

Failures failures_of(const Flavour& flavour, const char* profile = "argos3") {
  Failures failures;
  for (const ModuleReport& module : assess({flavour, *built_in_profile(profile), rvr()}).modules) {
    if (module.passes()) continue;
    failures.modules.emplace_back(id_of(module.module));
    for (const Check& check : module.checks)
      failures.notes += check.note;
  }
  return failures;
}

TEST(BrokenFlavour, ABlackThatTakesInGrayFailsBlackFloor) {
  Flavour flavour = watermelon();
  flavour.floor.black.high = 130'000;
  const Failures failures = failures_of(flavour);
  EXPECT_THAT(failures.modules, ElementsAre("black_floor"));
  EXPECT_THAT(failures.notes, HasSubstr("also take the floor 127, 127, 127 for it"));
}

TEST(BrokenFlavour, AWhiteThatNothingReachesFailsWhiteFloor) {
  Flavour flavour = watermelon();
  flavour.floor.white.low = 255'001;
  const Failures failures = failures_of(flavour);
  EXPECT_THAT(failures.modules, ElementsAre("white_floor"));
  EXPECT_THAT(failures.notes, HasSubstr("do not take the white disc (255, 255, 255) for it"));
}

TEST(BrokenFlavour, AGrayBesideTheFloorsFailsGrayFloor) {
  Flavour flavour = watermelon();
  flavour.floor.gray = {140'000, 170'000};
  EXPECT_THAT(failures_of(flavour).modules, ElementsAre("gray_floor"));
}

TEST(BrokenFlavour, ALabelWithAWrongHueFailsColorDetection) {
  Flavour flavour = watermelon();
  flavour.floor.labels[0].hue_deg = 60;  // green as yellow
  EXPECT_THAT(failures_of(flavour).modules, ElementsAre("color_detection"));
}

// The flavour's numbers are right, and yet robots cross the spot without reading it as black.
TEST(BrokenFlavour, ANoiseThatHidesTheSpotFailsBlackFloorWithTheReason) {
  Profile noisy = *built_in_profile("argos3");
  noisy.ground_color.sd = 4000;  // every channel is 0 or 255: black with probability 1/8
  Flavour flavour = watermelon();
  flavour.behaviours.clear();
  flavour.conditions.resize(1);
  const Report report = assess({flavour, noisy, rvr()});
  EXPECT_THAT(report.modules.at(0).checks.at(0).note, HasSubstr("the reading satisfied it in "));
  EXPECT_THAT(report.modules.at(0).checks.at(0).note, HasSubstr("did not fire over the black"));
  EXPECT_FALSE(report.passes());
}

TEST(BrokenFlavour, ARepulsionWithTheSignTurnedFails) {
  Flavour flavour = watermelon();
  flavour.neighbours.repulsion_gain = -flavour.neighbours.repulsion_gain;
  EXPECT_THAT(failures_of(flavour).modules, ElementsAre("repulsion"));
}

TEST(BrokenFlavour, AnAttractionWithTheSignTurnedFails) {
  Flavour flavour = watermelon();
  flavour.neighbours.attraction_gain = -flavour.neighbours.attraction_gain;
  EXPECT_THAT(failures_of(flavour).modules, ElementsAre("attraction"));
}

TEST(BrokenFlavour, AnExplorationThatSeesNothingFailsByContact) {
  Flavour flavour = watermelon();
  flavour.exploration.threshold = 2;  // no reading is that high
  flavour.behaviours.resize(1);
  flavour.conditions.clear();
  const Report report = assess({flavour, *built_in_profile("argos3"), rvr()});
  EXPECT_FALSE(report.modules.at(0).checks.at(1).passes);
  EXPECT_EQ(report.modules.at(0).checks.at(1).quantity, "contact_share");
}

TEST(BrokenFlavour, AnExplorationThatCrawlsFailsByTiles) {
  Flavour flavour = watermelon();
  flavour.speed_mps = 0.01;
  flavour.behaviours.resize(1);
  flavour.conditions.clear();
  const Report report = assess({flavour, *built_in_profile("argos3"), rvr()});
  EXPECT_FALSE(report.modules.at(0).checks.at(0).passes);
  EXPECT_EQ(report.modules.at(0).checks.at(0).quantity, "tiles_entered");
}

TEST(BrokenFlavour, AModuleInTheWrongTableIsRefused) {
  Flavour flavour = watermelon();
  flavour.behaviours.clear();
  flavour.conditions = {{.module = Module::Stop, .number = 0, .parameters = {}}};
  EXPECT_THROW(assess({flavour, *built_in_profile("argos3"), rvr()}), std::invalid_argument);
  flavour.behaviours = {{.module = Module::FixedProbability, .number = 0, .parameters = {}}};
  EXPECT_THROW(assess({flavour, *built_in_profile("argos3"), rvr()}), std::invalid_argument);
}

TEST(BrokenFlavour, AProbabilityThatIsNotSetFails) {
  Flavour flavour = watermelon();
  flavour.behaviours.clear();
  flavour.conditions.resize(1);
  flavour.conditions[0].parameters[0].name = "gamma";  // 0: the middle of 0 to 1, as an integer
  const Failures failures = failures_of(flavour);
  EXPECT_THAT(failures.modules, ElementsAre("black_floor"));
  EXPECT_THAT(failures.notes, HasSubstr("did not fire in "));
}

}  // namespace
}  // namespace swarmsmith::assessment
