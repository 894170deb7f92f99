#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/control/flavour.h"
#include "sim/control/module.h"
#include "sim/engine/profile.h"
#include "sim/robot/robot.h"

namespace swarmsmith::assessment {

/// Tests whether each module of a flavour behaves in the simulator as specified (thesis 6.2; in
/// measurable form: thesis facts, section 10). Three robots of a kind run for 120 s in the arena of
/// the thesis: behaviours with tau = 10 and alpha = 3 on seeds 1 to 5, conditions on seeds 1 to 10.

/// One quantity of a module, measured in several runs and compared with its expected value.
struct Check {
  std::string setting;         ///< arena and parameters, as text for users
  int runs = 0;                ///< number of simulated runs
  std::string quantity;        ///< the quantity in `values`, with its unit
  std::vector<double> values;  ///< one per run; for neighbour counts, one per robot and run
  bool passes = false;
  std::string measured;  ///< `values` as text for users
  std::string expected;  ///< the condition for passing, as text for users
  std::string note;      ///< why it fails, or other remarks; often empty
};

/// The rate at which a condition fired, among the cycles in which it was tested and its reading
/// satisfied it. Not part of the verdict.
struct Rate {
  std::string setting;
  std::int64_t trials = 0;
  std::int64_t firings = 0;
  double expected = 0;
  /// Wilson's 99 % interval of the rate; 0 to 1 without trials.
  double low = 0;
  double high = 1;
};

struct ModuleReport {
  Module module = Module::Stop;
  std::vector<Check> checks;
  std::vector<Rate> rates;  ///< for conditions

  bool passes() const;
};

struct Report {
  std::vector<ModuleReport> modules;  ///< in the flavour's order, behaviours first

  int passed() const;
  bool passes() const;
};

/// The reason, as a sentence, why modules cannot be assessed with the robot; nothing when they can:
/// a group of three must fit.
std::optional<std::string> too_big(const Robot& robot);

/// Receives the number of finished modules and their total.
using Progress = std::function<void(int done, int of)>;

/// The subject of an assessment: a flavour and a profile that fit the robot (`misfit`).
struct Subject {
  const Flavour& flavour;
  const Profile& profile;
  const Robot& robot;
};

/// Assesses all modules of the flavour. It is pure: the same subject gives the same report.
///
/// Conditions are tested with the profile's sensors, but with control cycles of exactly 0.1 s,
/// because they are judged cycle by cycle and a recorder observes the world every 0.1 s.
Report assess(const Subject& subject, const Progress& progress = {});

}  // namespace swarmsmith::assessment
