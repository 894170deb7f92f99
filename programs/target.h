#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace swarmsmith {

/// The batch systems that a targetRunner may put its jobs into (irace's batchmode).
enum class BatchMode { None, Sge, Pbs, Torque, Slurm, HtCondor };

/// Programs that evaluate configurations, in place of the simulator: irace's target-runner and
/// target-evaluator (irace facts, 18). Paths are absolute. Costs are what they print; a campaign's
/// scores are the negative of it.
struct Target {
  std::string runner;
  std::string launcher;  ///< program that starts the runner; empty for none
  /// What is put after the program's name; see `expand`.
  std::string command_line =
      "{configurationID} {instanceID} {seed} {instance} {bound} {targetRunnerArgs}";
  std::string evaluator;  ///< program that says the costs after a task's runs; empty for none
  std::string folder;     ///< in which all of them run
  std::int64_t retries = 0;
  std::int64_t timeout_s = 0;  ///< of a call; 0 for none
  /// A run that takes longer is a rejection of its configuration, in place of a failure.
  bool timeout_is_rejection = false;
  bool aclib = false;  ///< GenericWrapper4AC's convention in place of irace's
  BatchMode batch_mode = BatchMode::None;
  bool prints_time = false;  ///< max_time: a time must follow the cost
  /// Shorter times are raised to this; bounded runs may overrun by it.
  double min_measurable_time = 0.01;
  int debug_level = 0;

  friend bool operator==(const Target&, const Target&) = default;
};

/// irace's instances: a text each, whatever the programs make of it. Training instances are counted
/// from 1; test instances too, with a `t` after the number.
struct InstanceTexts {
  std::vector<std::string> training;
  std::vector<std::string> test;

  friend bool operator==(const InstanceTexts&, const InstanceTexts&) = default;
};

}  // namespace swarmsmith
