#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "irace_core/configuration.h"
#include "irace_core/parameter_space.h"
#include "irace_core/scenario.h"

namespace swarmsmith {

/// Everything in an irace user's files and command line, read and checked: `swarmsmith irace` runs
/// it, and `swarmsmith import` converts it to a campaign (irace facts, 21 to 23). Paths are
/// absolute, by the rules of irace facts, 21.
struct IraceSetup {
  Scenario race;  ///< n_instances is set; the seed is set only if `seed` is
  std::optional<std::uint64_t> seed;

  std::filesystem::path scenario_file;  ///< empty if there was none
  std::filesystem::path parameter_file;
  std::string parameter_text;  ///< text of the parameter file, with the dependency file included
  ParameterSpace space;
  std::filesystem::path configurations_file;  ///< empty for none
  std::string configurations_text;
  std::vector<Configuration> initial;

  /// instances, in the form in which the target-runner gets them.
  std::vector<std::string> training;
  std::filesystem::path training_folder;  ///< where they came from, if options give it
  std::filesystem::path training_file;
  std::vector<std::string> test;

  std::filesystem::path exec_dir;
  std::filesystem::path target_runner;
  std::filesystem::path target_runner_launcher;  ///< empty for none
  std::string target_cmdline =
      "{configurationID} {instanceID} {seed} {instance} {bound} {targetRunnerArgs}";
  std::filesystem::path target_evaluator;      ///< empty for none
  std::filesystem::path repair_configuration;  ///< a program; empty for none
  std::int64_t target_runner_retries = 0;
  std::int64_t target_runner_timeout = 0;
  bool aclib = false;
  bool rejects_failures = false;  ///< --on-failure reject
  std::string batchmode = "0";    ///< "0", "sge", "pbs", "torque", "slurm", "htcondor"

  std::filesystem::path log_file;  ///< irace's log file; empty for none
  /// The file of --store, otherwise the log file with `.db` instead of `.Rdata`; if empty, no store
  /// is kept.
  std::filesystem::path store;
  std::int64_t test_nb_elites = 1;
  bool test_iteration_elites = false;
  /// Number of parallel runs; nothing if no file and no switch gives it, which means the number of
  /// cores.
  std::optional<std::int64_t> parallel;
  bool quiet = false;
  std::int64_t debug_level = 0;

  /// Warnings: one sentence for each option that has no effect and for each fact that the user
  /// should know.
  std::vector<std::string> warnings;
};

}  // namespace swarmsmith
