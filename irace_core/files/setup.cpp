#include "irace_core/files/setup.h"

#include <system_error>
#include <utility>

#include "base/environment.h"
#include "irace_core/files/internal/setup_work.h"
#include "irace_core/files/scenario_file.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;
using irace::SetupWork;

/// The file that the command line names, or the default file if it exists; empty for none.
fs::path scenario_of(const IraceCommandLine& line, SetupWork& work) {
  const IraceOption& option = *find_irace_option("scenarioFile");
  if (const IraceSetting* setting = line.settings.find(option.name)) {
    return absolute_path(std::get<std::string>(setting->value), setting->folder);
  }
  const fs::path here = absolute_path(option.initial, work.around.folder);
  std::error_code ignored;
  if (!fs::exists(here, ignored)) return {};
  work.warn(here.string() + " is read, because it exists; to name it, write --scenario " +
            std::string(option.initial));
  return here;
}

}  // namespace

SetupSurroundings surroundings_of_process() {
  return {fs::current_path(), environment("PATH")};
}

IraceSetupOrErrors read_irace_setup(const IraceCommandLine& line,
                                    const SetupSurroundings& surroundings) {
  SetupWork work;
  work.action = line.action;
  work.around = surroundings;
  work.setup.scenario_file = scenario_of(line, work);
  if (!work.setup.scenario_file.empty()) {
    auto file = read_irace_scenario(work.setup.scenario_file);
    if (!file) return tl::unexpected(std::move(file.error()));
    work.scenario_folder = work.setup.scenario_file.parent_path();
    work.settings = std::move(file->settings);
    for (std::string& warning : file->warnings)
      work.warn(std::move(warning));
  }
  work.settings.override_with(line.settings);
  irace::apply_options(work);
  irace::read_instances(work);
  irace::read_parameters(work);
  irace::check_setup(work);
  if (!work.errors.empty()) return tl::unexpected(std::move(work.errors));
  return std::move(work.setup);
}

}  // namespace swarmsmith
