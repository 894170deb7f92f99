#include "coordinator/campaign/programs.h"

#include <unistd.h>
#include <filesystem>
#include <string>

#include "programs/command_line.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;

/// Reports problems of the program under this key, if the key is set.
void check_program(const std::string& path, const std::string& key, std::vector<Error>& errors) {
  if (path.empty()) return;
  std::error_code trouble;
  if (!fs::exists(path, trouble)) {
    errors.push_back({ErrorKind::NotFound, "`" + key + "`: there is no such program", path});
  } else if (!fs::is_regular_file(path, trouble)) {
    errors.push_back({ErrorKind::BadInput, "`" + key + "`: this is not a file", path});
  } else if (::access(path.c_str(), X_OK) != 0) {
    errors.push_back({ErrorKind::BadInput,
                      "`" + key + "`: the program is not executable; `chmod +x` makes it so",
                      path});
  }
}

}  // namespace

std::vector<Error> check_programs(const Campaign& campaign) {
  std::vector<Error> errors;
  check_program(campaign.repair, "repair_configuration", errors);
  if (!campaign.target) return errors;
  const Target& target = *campaign.target;
  if (target.launcher.empty()) {
    check_program(target.runner, "command", errors);
  } else if (std::error_code trouble; !fs::exists(target.runner, trouble)) {
    errors.push_back({ErrorKind::NotFound, "`command`: there is no such file", target.runner});
  }
  check_program(target.launcher, "launcher", errors);
  check_program(target.evaluator, "evaluator", errors);
  if (std::error_code trouble; !fs::is_directory(target.folder, trouble)) {
    errors.push_back({ErrorKind::NotFound, "`folder`: there is no such folder", target.folder});
  }
  if (target.aclib) return errors;
  for (const std::string& fault :
       faults_of_command_line(target.command_line, uses_capping(campaign.race))) {
    errors.push_back({ErrorKind::BadInput, fault, "command_line"});
  }
  return errors;
}

}  // namespace swarmsmith
