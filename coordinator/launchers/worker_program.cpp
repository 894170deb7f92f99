#include "coordinator/launchers/worker_program.h"

#include <unistd.h>

#include "base/program_path.h"

namespace swarmsmith {

std::vector<std::string> allow_arguments(const Target& target) {
  std::vector<std::string> arguments;
  for (const std::string& program : {target.runner, target.launcher, target.evaluator}) {
    if (program.empty()) continue;
    arguments.emplace_back("--allow");
    arguments.push_back(program);
  }
  arguments.emplace_back("--allow-shell");
  return arguments;
}

std::vector<std::string> address_arguments(const WorkerAddress& address) {
  std::vector<std::string> arguments;
  if (address.coordinator.empty()) {
    arguments = {"--connect", address.endpoint};
  } else {
    arguments = {"--coordinator", address.coordinator.string()};
  }
  if (!address.key.empty()) {
    arguments.emplace_back("--key");
    arguments.push_back(address.key.string());
  }
  return arguments;
}

Expected<std::filesystem::path> find_worker_program() {
  const std::filesystem::path program = sibling_program("SWARMSMITH_WORKER", "swarmsmith-worker");
  if (access(program.c_str(), X_OK) == 0) return program;
  return unexpected(ErrorKind::NotFound,
                    "no program to start workers with; install it beside this one, or name it in "
                    "SWARMSMITH_WORKER",
                    program.string());
}

std::string shell_line(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) {
    if (!line.empty()) line += ' ';
    line += '\'';
    for (const char letter : word) {
      if (letter == '\'') {
        line += R"('\'')";
      } else {
        line += letter;
      }
    }
    line += '\'';
  }
  return line;
}

}  // namespace swarmsmith
