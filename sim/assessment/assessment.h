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

/// Does each module of a flavour do in the simulator what it promises (thesis 6.2; its measurable
/// form: thesis facts, section 10)? Three robots of a kind in the thesis' arena, 120 s a run;
/// behaviours with tau = 10 and alpha = 3 on seeds 1 to 5, conditions on seeds 1 to 10.

/// One quantity of a module, measured in several runs, against what is expected of it.
struct Check {
  std::string setting;         ///< place and parameters, for people
  int runs = 0;                ///< how many were simulated
  std::string quantity;        ///< what `values` holds, with its unit
  std::vector<double> values;  ///< one a run; of neighbour counts, one a robot and run
  bool passes = false;
  std::string measured;  ///< `values` for people
  std::string expected;  ///< what passes, for people
  std::string note;      ///< why it fails, or what else a person should know; often empty
};

/// How often a condition fired of the cycles in which it was tested and its reading satisfied it.
/// Not part of the verdict.
struct Rate {
  std::string setting;
  std::int64_t trials = 0;
  std::int64_t firings = 0;
  double expected = 0;
  /// Wilson's 99 % interval of the rate; 0 to 1 without a trial.
  double low = 0;
  double high = 1;
};

struct ModuleReport {
  Module module = Module::Stop;
  std::vector<Check> checks;
  std::vector<Rate> rates;  ///< of conditions

  bool passes() const;
};

struct Report {
  std::vector<ModuleReport> modules;  ///< in the flavour's order, behaviours first

  int passed() const;
  bool passes() const;
};

/// Why modules cannot be assessed with the robot, as a sentence; nothing when they can: three of
/// them must have room in a group.
std::optional<std::string> too_big(const Robot& robot);

/// Receives the number of finished modules and their total.
using Progress = std::function<void(int done, int of)>;

/// What is assessed: a flavour and a profile that fit the robot (`misfit`).
struct Subject {
  const Flavour& flavour;
  const Profile& profile;
  const Robot& robot;
};

/// Assesses all modules of the flavour. Pure: the same subject gives the same report.
///
/// Conditions are tested with the profile's sensors, but with control cycles of exactly 0.1 s:
/// they are judged cycle by cycle, and a recorder sees the world every 0.1 s.
Report assess(const Subject& subject, const Progress& progress = {});

}  // namespace swarmsmith::assessment
