#include <exception>
#include <string>
#include <vector>

#include "base/process/begin_program.h"
#include "cli/completion/offer_stored.h"
#include "console/fault.h"
#include "storage/store.h"
#include "tracking/app/commands.h"

int main(int argc, char** argv) {
  swarmsmith::begin_program();
  using namespace swarmsmith;
  Output output = standard_output();
  swarmsmith::set_check_listener([&](const std::string& text) { print_note(output, text); });
  const Program program{
      "swarmsmith track", "Scores runs of real robots, filmed from above.", track_commands(),
      "docs/tracking.md leads from an empty arena to a first scored run.", cli::offer_stored};
  try {
    std::vector<std::string> arguments(argv + 1, argv + argc);
    if (!arguments.empty() && means_a_recording(arguments.front())) {
      arguments.insert(arguments.begin(), "score");
    }
    const ExitCode code = run_program(program, arguments, output);
    if (output.out.flush() || code != ExitCode::Done) return static_cast<int>(code);
    return static_cast<int>(fail(output, ExitCode::Failed,
                                 "standard output: the answer could not be written; is the disk "
                                 "full, or the output closed?"));
  } catch (const swarmsmith::StoreFailure& failure) {
    return static_cast<int>(
        fail(output, ExitCode::Store,
             {swarmsmith::ErrorKind::Corrupt,
              std::string("the store cannot be used: ") + failure.what(), failure.file()}));
  } catch (const std::exception& error) {
    // Failures of the environment: a full disk, no memory, a device that was removed.
    return static_cast<int>(fail(output, ExitCode::Failed, sentence_of_fault(error)));
  }
}
