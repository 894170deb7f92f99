#include <exception>
#include <string>
#include <vector>

#include "coordinator/cli/options.h"

int main(int argc, char** argv) {
  using namespace swarmsmith::cli;
  Output output = standard_output();
  try {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    return static_cast<int>(run_program(arguments, output));
  } catch (const std::exception& error) {
    // What the environment refused: a full disk, no memory, a store that goes away under us.
    return static_cast<int>(fail(output, ExitCode::Failed, std::string(error.what())));
  }
}
