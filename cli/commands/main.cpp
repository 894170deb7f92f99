#include <exception>
#include <string>
#include <vector>

#include "base/process/begin_program.h"
#include "cli/commands/commands.h"
#include "console/fault.h"
#include "storage/store.h"

int main(int argc, char** argv) {
  swarmsmith::begin_program();
  using namespace swarmsmith;
  Output output = standard_output();
  swarmsmith::set_check_listener([&](const std::string& text) { print_note(output, text); });
  try {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    const ExitCode code = cli::run_program(arguments, output);
    if (output.out.flush() || code != ExitCode::Done) return static_cast<int>(code);
    return static_cast<int>(
        fail(output, ExitCode::Failed,
             "standard output: the answer could not be written; is the disk full, or the output "
             "closed?"));
  } catch (const swarmsmith::StoreFailure& failure) {
    const std::string message = std::string("the store cannot be used: ") + failure.what() +
                                "; restore it from a backup, or let `swarmsmith recover` make a "
                                "new store from what can be read";
    return static_cast<int>(
        fail(output, ExitCode::Store, {swarmsmith::ErrorKind::Corrupt, message, failure.file()}));
  } catch (const std::exception& error) {
    // Failures of the environment: a full disk, no memory, a store that disappears while it is
    // used.
    return static_cast<int>(fail(output, ExitCode::Failed, sentence_of_fault(error)));
  }
}
