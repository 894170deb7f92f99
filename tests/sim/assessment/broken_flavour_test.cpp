#include <stdexcept>

#include "sim/assessment/assessment.h"
#include "sim/files/profile_file.h"
#include "tests/support/checks.h"

// A flavour with one wrong number fails in the module that uses it, and in no other.

namespace swarmsmith::assessment {
namespace {

struct Failures {
  std::vector<std::string> modules;
  std::string notes;
};

Failures failures_of(const Flavour& flavour) {
  Failures failures;
  for (const ModuleReport& module : assess({flavour, *built_in_profile("argos3"), rvr()}).modules) {
    if (module.passes()) continue;
    failures.modules.emplace_back(id_of(module.module));
    for (const Check& check : module.checks)
      failures.notes += check.note;
  }
  return failures;
}

struct Break {
  const char* name;
  void (*change)(Flavour&);
  const char* module;
  const char* note = "";
};

const Break kBreaks[] = {
    {"a black that takes in grey", [](Flavour& f) { f.floor.black.high = 130'000; }, "black_floor",
     "the floor 127, 127, 127 also satisfies it"},
    {"a white that nothing reaches", [](Flavour& f) { f.floor.white.low = 255'001; }, "white_floor",
     "the white disc (255, 255, 255) does not satisfy it"},
    {"a grey beside the floors",
     [](Flavour& f) {
       f.floor.gray = {140'000, 170'000};
     },
     "gray_floor"},
    {"green as yellow", [](Flavour& f) { f.floor.labels[0].hue_deg = 60; }, "color_detection"},
    {"a repulsion with the sign turned", [](Flavour& f) { f.neighbours.repulsion_gain *= -1; },
     "repulsion"},
    {"an attraction with the sign turned", [](Flavour& f) { f.neighbours.attraction_gain *= -1; },
     "attraction"},
    {"a probability that is not set",
     [](Flavour& f) {
       f.behaviours.clear();
       f.conditions.resize(1);
       f.conditions[0].parameters[0].name = "gamma";  // 0: the middle of 0 to 1, as an integer
     },
     "black_floor", "did not fire in "}};

TEST(BrokenFlavour, FailsInTheModuleThatUsesTheNumberAlone) {
  for (const Break& one : kBreaks) {
    Flavour flavour = watermelon();
    one.change(flavour);
    const Failures failures = failures_of(flavour);
    EXPECT_THAT(failures.modules, ElementsAre(one.module)) << one.name;
    EXPECT_THAT(failures.notes, HasSubstr(one.note)) << one.name;
  }
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

}  // namespace
}  // namespace swarmsmith::assessment
