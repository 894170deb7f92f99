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

/// Everything that an irace user's files and command line say, read and checked: what
/// `swarmsmith irace` runs and `swarmsmith import` turns into a campaign (irace facts, 21 to 23).
/// Paths are absolute, with the rules of irace facts, 21.
struct IraceSetup {
  Scenario race;  ///< n_instances is set; the seed only if `seed` is
  std::optional<std::uint64_t> seed;

  std::filesystem::path scenario_file;  ///< empty when there was none
  std::filesystem::path parameter_file;
  std::string parameter_text;  ///< of the file, dependency file worked in
  ParameterSpace space;
  std::filesystem::path configurations_file;  ///< empty for none
  std::string configurations_text;
  std::vector<Configuration> initial;

  std::vector<std::string> training;      ///< instances, as they reach the target-runner
  std::filesystem::path training_folder;  ///< where they came from, as far as options say it
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

  std::filesystem::path log_file;  ///< irace's; empty for none
  /// The file of --store, else the log file with `.db` in place of `.Rdata`; empty: nothing is
  /// kept.
  std::filesystem::path store;
  std::int64_t test_nb_elites = 1;
  bool test_iteration_elites = false;
  /// Runs at a time; nothing when no file and no switch says it: as many as there are cores.
  std::optional<std::int64_t> parallel;
  bool quiet = false;
  std::int64_t debug_level = 0;

  /// Warnings: one sentence for each option without effect and each notable fact.
  std::vector<std::string> warnings;
};

}  // namespace swarmsmith
