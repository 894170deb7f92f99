#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/assessment/internal/settings.h"
#include "sim/control/conditions.h"
#include "sim/mission/arena.h"

namespace swarmsmith::assessment {

/// The reading to which a condition responds: the floor (and, for a colour detector, which colour),
/// the number of neighbours, no reading, or other readings.
enum class Trigger { Always, Gray, Label, Neighbours, NeighboursInverted, Readings };

/// A condition, with an arena in which it can be satisfied.
struct ConditionTest {
  Module module = Module::FixedProbability;
  Trigger trigger = Trigger::Always;
  GrayRange gray;  ///< for Trigger::Gray, from the flavour
  ColorLabel label = ColorLabel::Green;
  std::string floor;          ///< the part of the floor that satisfies it, as text for users
  Rgb wanted{127, 127, 127};  ///< the colour of that part
  Arena arena;
};

/// The tests of a module, one per colour for colour detection. Throws std::invalid_argument when it
/// is not a condition.
std::vector<ConditionTest> tests_of(const ModuleSpec& spec, const Flavour& flavour);

/// Whether the condition responds to the number of neighbours.
inline bool is_of_neighbours(const ConditionTest& test) {
  return test.trigger == Trigger::Neighbours || test.trigger == Trigger::NeighboursInverted;
}

/// Whether the reading satisfies the condition by the flavour's numbers (thesis facts, section 7).
/// It is computed here independently, in order to find errors in the control software.
bool satisfies(const ConditionTest& test, Rgb reading, const FloorModel& floor);

/// Parameters of the conditions by name: beta, and the sigmoid parameters for counts. Other
/// parameters get the middle of their range.
struct ConditionParameters {
  double beta = 1;
  double eta = 0;
  double xi = 1;
};
Condition make_condition(const ConditionTest& test, const ModuleSpec& spec,
                         const ConditionParameters& parameters);

/// The probability with which `condition` must fire in this cycle. For Trigger::Readings it is the
/// probability that the control software computes from the recorded readings, so the test is
/// whether the machine acts on it. For other triggers it is `probability` if the reading satisfies
/// the test.
double due_probability(const ConditionTest& test, const Condition& condition, double probability,
                       const Readings& readings, const Flavour& flavour);

/// Whether the points of the robot's ground sensor are over the wanted colour: all of them, or any
/// one if that is enough for the flavour.
bool is_over_wanted(const ConditionTest& test, const Subject& subject, const Pose& pose);

/// One control cycle of a robot, as recorded.
struct ObservedCycle {
  int seed = 0;
  int robot = 0;
  int state = 0;        ///< before the transition test
  bool tested = false;  ///< conditions are not tested in the first cycle of a state
  bool fired = false;   ///< the state changed
  const RobotRecord& record;
};

/// Runs the machine in the test's arena on each seed and passes all control cycles to `tell`, robot
/// by robot within an instant. Needs a profile with a control period of 0.1 s: one cycle per
/// instant.
void for_each_cycle(const ConditionTest& test, const Machine& machine, const Subject& subject,
                    const std::function<void(const ObservedCycle&)>& tell);

}  // namespace swarmsmith::assessment
