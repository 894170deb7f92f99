#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace swarmsmith {

/// The batch systems to which a targetRunner may submit jobs (irace's batchmode).
enum class BatchMode { None, Sge, Pbs, Torque, Slurm, HtCondor };

/// Programs that evaluate configurations instead of the simulator: irace's target-runner and
/// target-evaluator (irace facts, 18). Paths are absolute. The programs print costs; a campaign's
/// scores are the negative costs.
struct Target {
  std::string runner;
  std::string launcher;  ///< program that starts the runner; empty: none
  /// The text after the program's name; see `arguments_of`.
  std::string command_line =
      "{configurationID} {instanceID} {seed} {instance} {bound} {targetRunnerArgs}";
  std::string evaluator;  ///< program that returns the costs after a task's runs; empty: none
  std::string folder;     ///< working directory of all these programs
  std::int64_t retries = 0;
  std::int64_t timeout_s = 0;  ///< per call; 0: no limit
  /// A run that takes longer rejects its configuration instead of failing.
  bool timeout_is_rejection = false;
  bool aclib = false;  ///< the convention of GenericWrapper4AC instead of irace's
  BatchMode batch_mode = BatchMode::None;
  bool prints_time = false;  ///< max_time: a time must follow the cost
  /// Shorter times are raised to this one; bounded runs may exceed their bound by it.
  double min_measurable_time = 0.01;
  int debug_level = 0;

  friend bool operator==(const Target&, const Target&) = default;
};

/// irace's instances: texts that only the programs interpret. Training instances are numbered from
/// 1; test instances too, with a `t` after the number.
struct InstanceTexts {
  std::vector<std::string> training;
  std::vector<std::string> test;

  friend bool operator==(const InstanceTexts&, const InstanceTexts&) = default;
};

}  // namespace swarmsmith
