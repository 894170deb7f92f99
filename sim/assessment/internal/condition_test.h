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

/// What a condition answers to: the floor (and which colour, for a detector of colours), the number
/// of neighbours, nothing, or other readings.
enum class Trigger { Always, Gray, Label, Neighbours, NeighboursInverted, Readings };

/// A condition in an arena where it meets what it waits for.
struct ConditionTest {
  Module module = Module::FixedProbability;
  Trigger trigger = Trigger::Always;
  GrayRange gray;  ///< of Trigger::Gray: the flavour's own
  ColorLabel label = ColorLabel::Green;
  std::string floor;          ///< the part of the floor that it waits for, for people
  Rgb wanted{127, 127, 127};  ///< its colour
  Arena arena;
};

/// The tests of a module, one a colour for colour detection. Throws std::invalid_argument when it
/// is not a condition.
std::vector<ConditionTest> tests_of(const ModuleSpec& spec, const Flavour& flavour);

/// Whether the flavour's numbers say that the reading satisfies the condition (thesis facts,
/// section 7): worked out here once more, so that a slip in the control software shows.
bool satisfies(const ConditionTest& test, Rgb reading, const FloorModel& floor);

/// Parameters of the conditions by name: beta, and the sigmoid's for counts. Of any other name it
/// is the middle of its range.
struct ConditionParameters {
  double beta = 1;
  double eta = 0;
  double xi = 1;
};
Condition make_condition(const ConditionTest& test, const ModuleSpec& spec,
                         const ConditionParameters& parameters);

/// The probability with which `condition` must fire in this cycle. Of Trigger::Readings it is what
/// the control software makes of the recorded readings: then the test is that the machine acts on
/// it. Of the others it is `probability` where the reading satisfies the test.
double due_probability(const ConditionTest& test, const Condition& condition, double probability,
                       const Readings& readings, const Flavour& flavour);

/// Whether the places of the floor that the robot's ground sensors look at are of the wanted
/// colour: all of them, or any where that is enough for the flavour.
bool is_over_wanted(const ConditionTest& test, const Subject& subject, const Pose& pose);

/// One robot's control cycle as the recorder saw it.
struct ObservedCycle {
  int seed = 0;
  int robot = 0;
  int state = 0;        ///< before the transition test
  bool tested = false;  ///< nothing is tested in the first cycle of a state
  bool fired = false;   ///< the state changed
  const RobotRecord& record;
};

/// Runs the test's arena on each seed with the machine and tells of all control cycles, robot by
/// robot within an instant. Needs a profile whose control period is 0.1 s, one cycle an instant.
void for_each_cycle(const ConditionTest& test, const Machine& machine, const Subject& subject,
                    const std::function<void(const ObservedCycle&)>& tell);

}  // namespace swarmsmith::assessment
