#include "sim/control/reference_model.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "sim/control/flavour.h"
#include "sim/control/readings.h"
#include "tests/sim/control/fake_senses.h"
#include "tests/sim/control/page.h"
#include "tests/support/not_empty.h"

namespace swarmsmith {
namespace {

/// 1.55, 16000, 2 pi.
std::string bound(double value) {
  if (value > 6.28 && value < 6.29) return "2 pi";
  return short_text(value);
}

/// A line of the table in docs/robot.md, up to the column of remarks.
std::string line_of(const ReferenceEntry& entry) {
  const std::string count = entry.count == 0 ? "one a neighbour" : std::to_string(entry.count);
  return "| " + std::string(entry.device) + " | `" + std::string(entry.variable) + "` | " + count +
         " | [" + bound(entry.least) + ", " + bound(entry.most) + (entry.below_most ? ")" : "]") +
         " | " + std::string(entry.unit.empty() ? "1" : entry.unit) + " |";
}

TEST(ReferenceModel, StandsInTheRobotsPageLineByLine) {
  const std::string page = page_text("robot.md");
  for (const ReferenceEntry& entry : not_empty(reference_model())) {
    EXPECT_NE(page.find("\n" + line_of(entry)), std::string::npos)
        << "docs/robot.md lacks the line\n"
        << line_of(entry);
  }
}

TEST(ReferenceModel, FrontSensorsAreThoseThatLookAhead) {
  for (std::size_t i = 0; i < kProximityDirections.size(); ++i)
    EXPECT_EQ(kProximityDirections[i].x > 0, i < kFrontSensors) << i;
}

TEST(ReferenceModel, HasTheVariablesOfTheThesisTable) {
  std::string variables;
  for (const ReferenceEntry& entry : reference_model())
    variables += std::string(entry.device) + " " + std::string(entry.variable) + "\n";
  EXPECT_EQ(variables,
            "proximity prox\nproximity angle\nlight light\nground colour R\nground colour G\n"
            "ground colour B\nneighbours d\nneighbours angle\nwheels v\nLEDs R\nLEDs G\nLEDs B\n");
}

TEST(ReferenceModel, ProxOfTheThesisKeepsToItsRange) {
  const ReferenceEntry& prox = reference_model()[0];
  for (const Flavour* flavour : {&watermelon(), &chocolate()}) {
    EXPECT_EQ(obstacle_strength(-kNothing, flavour->obstacles), prox.most);
    EXPECT_EQ(obstacle_strength(kBlindZone_m, flavour->obstacles), prox.most);
    EXPECT_EQ(obstacle_strength(kProximityRange_m, flavour->obstacles), prox.least);
    EXPECT_EQ(obstacle_strength(kNothing, flavour->obstacles), prox.least);
  }
}

TEST(ReferenceModel, CommandsAreCutToTheWheelsRange) {
  const ReferenceEntry& wheels = reference_model()[8];
  EXPECT_EQ(within_wheel_speed(-2), wheels.least);
  EXPECT_EQ(within_wheel_speed(3), wheels.most);
  EXPECT_EQ(within_wheel_speed(0.3), 0.3);
  EXPECT_EQ(within_wheel_speed(-0.3), -0.3);
  EXPECT_EQ(wheels.most, 1.55);  // 155 cm/s
}

TEST(ReferenceModel, TheFlavoursSpeedsAreWithinTheWheelsRange) {
  for (const Flavour* flavour : not_empty(flavours_for(kRvrModel))) {
    EXPECT_GE(flavour->speed_mps, 0.25) << "slower the motors overheat (thesis 6.1)";
    EXPECT_LE(flavour->speed_mps, kMaxWheelSpeed_mps);
  }
}

}  // namespace
}  // namespace swarmsmith
