#include <system_error>

#include "irace_core/files/instances_file.h"
#include "irace_core/files/internal/setup_work.h"

namespace swarmsmith::irace {
namespace {

namespace fs = std::filesystem;

constexpr const char* kOldFolder = "./Instances";  // irace 3.5's default

/// The options of one kind of instances.
struct Names {
  std::string_view vector;
  std::string_view folder;
  std::string_view file;
};
constexpr Names kTraining = {"instances", "trainInstancesDir", "trainInstancesFile"};
constexpr Names kTest = {"testInstances", "testInstancesDir", "testInstancesFile"};

/// The path that an option sets; empty if it is not set.
fs::path path_of(const SetupWork& work, std::string_view option) {
  const IraceSetting* setting = work.settings.find(option);
  return setting == nullptr ? fs::path()
                            : absolute_path(std::get<std::string>(setting->value), setting->folder);
}

/// The instances that the options give; empty if no option gives any, or after an error.
std::vector<std::string> instances_of(SetupWork& work, const Names& names) {
  if (const IraceSetting* vector = work.settings.find(names.vector)) {
    return std::get<std::vector<std::string>>(vector->value);
  }
  const fs::path folder = path_of(work, names.folder);
  const fs::path file = path_of(work, names.file);
  if (folder.empty() && file.empty()) return {};
  auto instances = file.empty() ? list_instances(folder) : read_instances_file(file, folder);
  if (instances) return std::move(*instances);
  const std::string_view option = file.empty() ? names.folder : names.file;
  work.complain(option, to_string(instances.error()));
  return {};
}

/// The folder that irace 3.5 uses if none is given; empty if it does not exist.
fs::path old_folder(const SetupWork& work) {
  std::error_code ignored;
  for (const fs::path& begin : {work.around.folder, work.scenario_folder}) {
    const fs::path folder = absolute_path(kOldFolder, begin);
    if (!begin.empty() && fs::is_directory(folder, ignored)) return folder;
  }
  return {};
}

/// Warns about a list without a folder whose lines are files of irace 3.5's default folder.
void warn_about_old_folder(SetupWork& work) {
  const fs::path folder = old_folder(work);
  if (folder.empty() || work.setup.training.empty()) return;
  if (work.settings.find(kTraining.file) == nullptr) return;
  if (work.settings.find(kTraining.folder) != nullptr) return;
  const std::string& first = work.setup.training.front();
  std::error_code ignored;
  if (fs::exists(absolute_path(first, work.setup.exec_dir), ignored)) return;
  if (!fs::exists(absolute_path(first, folder), ignored)) return;
  work.warn("`trainInstancesDir` is not set: irace 3.5 would put " + folder.string() +
            "/ before each instance, irace 4 does not; write trainInstancesDir = \"" +
            std::string(kOldFolder) + "\" to get the same");
}

void read_training(SetupWork& work) {
  const std::size_t complaints = work.errors.size();
  std::vector<std::string>& training = work.setup.training;
  training = instances_of(work, kTraining);
  work.setup.training_folder = path_of(work, kTraining.folder);
  work.setup.training_file = path_of(work, kTraining.file);
  if (training.empty() && work.errors.size() == complaints) {
    const bool was_said = work.settings.find(kTraining.folder) != nullptr;
    const fs::path folder = was_said ? fs::path() : old_folder(work);
    if (!folder.empty()) {
      if (auto instances = list_instances(folder)) {
        training = std::move(*instances);
        work.warn("no option says where the training instances are; those of " + folder.string() +
                  " are used, as irace 3.5 does");
      }
    }
    if (training.empty() && work.action != IraceAction::OnlyTest) {
      work.complain(
          kTraining.file,
          "no training instances given: name a list of them (trainInstancesFile, "
          "--train-instances-file) or their folder (trainInstancesDir, --train-instances-dir)");
    }
  }
  if (!training.empty()) {
    work.setup.race.n_instances = static_cast<std::int64_t>(training.size());
  }
  warn_about_old_folder(work);
}

}  // namespace

void read_instances(SetupWork& work) {
  read_training(work);
  const std::size_t complaints = work.errors.size();
  work.setup.test = instances_of(work, kTest);
  const bool none = work.setup.test.empty() && work.errors.size() == complaints;
  if (none && work.action == IraceAction::OnlyTest) {
    work.complain(kTest.file,
                  "--only-test needs test instances: name a list of them (testInstancesFile, "
                  "--test-instances-file) or their folder (testInstancesDir, "
                  "--test-instances-dir)");
  }
}

}  // namespace swarmsmith::irace
