#include <array>
#include <string>
#include <system_error>
#include <utility>

#include "irace_core/files/internal/programs.h"
#include "irace_core/files/internal/setup_work.h"
#include "irace_core/internal/schedule.h"
#include "irace_core/iterated_race.h"

namespace swarmsmith::irace {
namespace {

namespace fs = std::filesystem;

void check_programs(SetupWork& work) {
  const IraceSetup& setup = work.setup;
  std::error_code ignored;
  if (setup.target_runner_launcher.empty()) {
    if (const auto complaint = complaint_about_program(setup.target_runner)) {
      work.complain("targetRunner", *complaint);
    }
  } else {
    // With a launcher, the launcher is the program that is run.
    if (!fs::exists(setup.target_runner, ignored)) {
      work.complain("targetRunner", "there is no such file: " + setup.target_runner.string());
    }
    if (const auto complaint = complaint_about_program(setup.target_runner_launcher)) {
      work.complain("targetRunnerLauncher", *complaint);
    }
  }
  const std::array<std::pair<std::string_view, const fs::path*>, 2> others = {
      {{"targetEvaluator", &setup.target_evaluator},
       {"repairConfiguration", &setup.repair_configuration}}};
  for (const auto& [option, program] : others) {
    if (program->empty()) continue;
    if (const auto complaint = complaint_about_program(*program)) work.complain(option, *complaint);
  }
  if (setup.batchmode != "0" && setup.target_evaluator.empty()) {
    work.complain(
        "batchmode",
        "needs `targetEvaluator`: the program that prints the costs when the jobs are done");
  }
}

void check_command_line(SetupWork& work) {
  const std::string& line = work.setup.target_cmdline;
  const bool bounded = uses_capping(work.setup.race);
  for (const std::string_view word : {"{seed}", "{instance}", "{targetRunnerArgs}", "{bound}"}) {
    if (word == "{bound}" && !bounded) continue;
    if (line.find(word) != std::string::npos) continue;
    const bool is_old = work.settings.find("targetRunnerLauncherArgs") != nullptr;
    work.complain(is_old ? "targetRunnerLauncherArgs" : "targetCmdline",
                  "must contain " + std::string(word) + ", found \"" + line + "\"");
  }
}

void check_folders(SetupWork& work) {
  std::error_code ignored;
  if (!fs::is_directory(work.setup.exec_dir, ignored)) {
    work.complain("execDir",
                  "there is no such folder: " + work.setup.exec_dir.string() + "; make it first");
    return;  // the path of the log depends on it
  }
  if (work.setup.store.empty()) return;
  const fs::path folder = work.setup.store.parent_path();
  const char* option = work.settings.find("--store") != nullptr ? "--store" : "logFile";
  if (!fs::is_directory(folder, ignored)) {
    work.complain(option, "there is no folder " + folder.string() + " for it; make it first");
  } else if (fs::is_directory(work.setup.store, ignored)) {
    work.complain(option, work.setup.store.string() + " is a folder; name a file");
  }
}

void check_race(SetupWork& work) {
  const Scenario& race = work.setup.race;
  const bool tunes = work.action != IraceAction::OnlyTest;
  if (tunes && race.max_experiments == 0 && race.max_time <= 0) {
    work.complain(
        "maxExperiments",
        "no budget given: set maxExperiments (--max-experiments) or maxTime (--max-time)");
    return;
  }
  if (race.max_experiments > 0 && race.max_time > 0) {
    // `minExperiments` raises `maxExperiments` (irace facts, 3.4): the user may have set it alone.
    const auto given = work.settings.number("maxExperiments");
    work.complain("maxTime", given.value_or(0) > 0
                                 ? "is given together with `maxExperiments`: a budget is one of "
                                   "the two; set the other one to 0"
                                 : "is given together with `minExperiments`, which is a number of "
                                   "experiments: a budget is experiments or time; leave one of "
                                   "them out");
    return;
  }
  const auto checked = check(race);
  if (!checked && tunes) {
    const Error error = with_irace_option_names(checked.error());
    work.complain(error.where, error.message);
  }
}

/// Checks whether the budget is enough for the parameters; only if there are no other errors.
void check_budget(SetupWork& work) {
  if (work.action == IraceAction::OnlyTest || !work.errors.empty()) return;
  const IraceSetup& setup = work.setup;
  const std::int64_t survive =
      irace::Schedule(setup.race, setup.space.variable_count()).min_survival();
  if (setup.race.nb_configurations > 0 && setup.race.nb_configurations <= survive) {
    work.complain("nbConfigurations", "must be more than the configurations that survive a race, " +
                                          std::to_string(survive) + " (minNbSurvival), found " +
                                          std::to_string(setup.race.nb_configurations));
    return;
  }
  const auto race = IteratedRace::start(setup.space, setup.race, setup.initial);
  // Other errors of the first race are reported when it is run, after repairs.
  if (race || race.error().where != "max_experiments") return;
  work.complain("maxExperiments", race.error().message);
}

}  // namespace

void check_setup(SetupWork& work) {
  check_folders(work);
  check_programs(work);
  check_command_line(work);
  check_race(work);
  check_budget(work);
}

}  // namespace swarmsmith::irace
