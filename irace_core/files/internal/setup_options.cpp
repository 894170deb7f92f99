#include <algorithm>
#include <system_error>

#include "irace_core/files/internal/programs.h"
#include "irace_core/files/internal/setup_fields.h"
#include "irace_core/files/internal/setup_work.h"

namespace swarmsmith::irace {
namespace {

namespace fs = std::filesystem;

/// The path for an option that is not set. irace looks for it in the current folder; if it exists
/// only beside the scenario, that is the file that the user means.
fs::path default_path(SetupWork& work, const IraceOption& option) {
  const fs::path here = absolute_path(option.initial, work.around.folder);
  if (option.kind == IraceKind::Folder || work.scenario_folder.empty()) return here;
  const fs::path beside = absolute_path(option.initial, work.scenario_folder);
  std::error_code ignored;
  if (beside == here || fs::exists(here, ignored) || !fs::exists(beside, ignored)) return here;
  work.warn("`" + std::string(option.name) + "` is not set, and there is no " + here.string() +
            ": " + beside.string() + " is used");
  return beside;
}

fs::path program_path(SetupWork& work, const IraceSetting& setting, const std::string& name) {
  const fs::path program = find_program(name, setting.folder, work.around.search_path);
  const fs::path beside = absolute_path(name, setting.folder);
  std::error_code ignored;
  if (program != beside && fs::exists(beside, ignored)) {
    work.warn(setting.where + ": `" + name + "` is " + program.string() +
              ", found in PATH; write `./" + name + "` for " + beside.string());
  }
  return program;
}

fs::path path_of(SetupWork& work, const IraceOption& option) {
  const IraceSetting* setting = work.settings.find(option.name);
  const auto* text = setting == nullptr ? nullptr : std::get_if<std::string>(&setting->value);
  // An empty text unsets an option (irace facts, 22); but an empty logFile means "no log" (irace
  // facts, 20).
  if (text == nullptr || (text->empty() && option.name != "logFile")) {
    if (option.name == "logFile") return absolute_path(option.initial, work.setup.exec_dir);
    return option.initial.empty() ? fs::path() : default_path(work, option);
  }
  if (option.name == "logFile") return absolute_path(*text, work.setup.exec_dir);
  if (option.kind == IraceKind::Program) return program_path(work, *setting, *text);
  return absolute_path(*text, setting->folder);
}

/// In irace 3.5, the arguments of the launcher have one word for everything that irace 4 names
/// separately.
void read_launcher_arguments(SetupWork& work) {
  const auto arguments = work.settings.text("targetRunnerLauncherArgs");
  if (!arguments || arguments->empty()) return;
  if (work.settings.find("targetCmdline") != nullptr) {
    work.complain("targetRunnerLauncherArgs",
                  "is given together with `targetCmdline`, which replaces it: leave it out");
    return;
  }
  if (work.setup.target_runner_launcher.empty()) {
    work.warn("`targetRunnerLauncherArgs` has no effect without `targetRunnerLauncher`");
    return;
  }
  constexpr std::string_view kAll = "{targetRunnerArgs}";
  const std::string whole(find_irace_option("targetCmdline")->initial);
  std::string line = *arguments;
  const std::size_t place = line.find(kAll);
  if (place != std::string::npos) line.replace(place, kAll.size(), whole);
  work.setup.target_cmdline = line;
}

fs::path store_of(const SetupWork& work) {
  const IraceSetting* given = work.settings.find("--store");
  if (given != nullptr) return absolute_path(std::get<std::string>(given->value), given->folder);
  fs::path store = work.setup.log_file;
  if (store.extension() == ".Rdata") store.replace_extension(".db");
  return store;
}

}  // namespace

void apply_options(SetupWork& work) {
  IraceSetup& setup = work.setup;
  // execDir is the first field, because the path of logFile depends on it.
  for (const SetupField& field : setup_fields()) {
    const IraceOption& option = *find_irace_option(field.name);
    const IraceSetting* setting = work.settings.find(field.name);
    if (option.is_path()) {
      field.set(setup, path_of(work, option).string());
    } else if (setting != nullptr && setting->value != IraceValue(std::string())) {
      field.set(setup, setting->value);
    }
  }
  read_launcher_arguments(work);
  setup.store = store_of(work);
  if (setup.seed) setup.race.seed = *setup.seed;
  setup.race.parallel = setup.parallel.value_or(0);
  setup.race.target_evaluator = !setup.target_evaluator.empty();
  // irace facts, 3.4.
  setup.race.max_experiments =
      std::max(setup.race.max_experiments, setup.race.min_experiments.value_or(0));
  if (setup.race.postselection && !setup.race.elitist) {
    setup.race.postselection = false;
    if (work.settings.find("postselection") != nullptr) {
      work.warn("`postselection` has no effect without `elitist`: there is no last race");
    }
  }
}

}  // namespace swarmsmith::irace
