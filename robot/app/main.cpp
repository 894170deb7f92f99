#include <exception>
#include <string>
#include <vector>

#include "base/process/begin_program.h"
#include "cli/completion/offer_stored.h"
#include "console/fault.h"
#include "robot/app/commands.h"

int main(int argc, char** argv) {
  swarmsmith::begin_program();
  using namespace swarmsmith;
  Output output = standard_output();
  const Program program{"swarmsmith robot",
                        "Runs machines on real robots, or in a simulated world.", robot_commands(),
                        "docs/robot-runtime.md leads from a flashed computer to a first run.",
                        cli::offer_stored};
  try {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    const ExitCode code = run_program(program, arguments, output);
    if (output.out.flush() || code != ExitCode::Done) return static_cast<int>(code);
    return static_cast<int>(fail(output, ExitCode::Failed,
                                 "standard output: the answer could not be written; is the disk "
                                 "full, or the output closed?"));
  } catch (const std::exception& error) {
    // Errors of the environment: a full disk, no memory, a device that disappears.
    return static_cast<int>(fail(output, ExitCode::Failed, sentence_of_fault(error)));
  }
}
