#include "coordinator/design/repair.h"

#include <memory>
#include <utility>

#include "base/process/interrupt.h"
#include "base/process/process.h"
#include "irace_core/files/configurations_file.h"

namespace swarmsmith {
namespace {

std::string how_it_failed(const ProcessEnd& end) {
  // If a signal kills the program, the shell's exit code is the signal plus 128.
  constexpr int kShells = 128;
  constexpr int kMostSignals = 64;
  const bool is_shells = end.exit_code > kShells && end.exit_code <= kShells + kMostSignals;
  const int signal = is_shells ? end.exit_code - kShells : end.signal;
  if (signal != 0) return "the program was killed by signal " + std::to_string(signal);
  return "the program ended with exit status " + std::to_string(end.exit_code) + ", which is not 0";
}

/// The end of a program's output, for messages.
std::string excerpt(const Captured& captured) {
  constexpr std::size_t kMost = 500;
  const std::string& text = captured.text;
  return text.size() > kMost ? "..." + text.substr(text.size() - kMost) : text;
}

Error failure(const std::string& program, const std::string& reason, const ProcessEnd& end) {
  return {ErrorKind::BadInput,
          reason + "; it printed \"" + excerpt(end.output) + "\" and, as errors, \"" +
              excerpt(end.errors) + "\"",
          "repair_configuration " + program};
}

}  // namespace

Repair repair_by(const std::string& program, const std::string& folder,
                 std::shared_ptr<const MethodSpace> space) {
  auto interrupt = std::make_shared<Interrupt>();
  return [program, folder, space = std::move(space),
          interrupt = std::move(interrupt)](const Configuration& given) -> Expected<Configuration> {
    const ParameterSpace& parameters = space->parameters();
    const auto table = print_configurations_file(parameters, std::span(&given, 1));
    if (!table) return Unexpected(table.error());
    // `run_process` gives programs no input, so a shell pipes the configuration in.
    // Irace facts, 8.5: in irace the repair is an R function; here a program takes its place.
    const ProcessCall call{
        .words = {"/bin/sh", "-c", R"(printf '%s' "$1" | "$0")", program, *table},
        .folder = folder};
    const auto end = run_process(call, *interrupt);
    if (!end) return Unexpected(end.error());
    if (end->signal != 0 || end->exit_code != 0) {
      return Unexpected(failure(program, how_it_failed(*end), *end));
    }
    auto repaired = parse_configurations_file({end->output.text, "its output"}, parameters);
    if (!repaired) {
      return Unexpected(failure(
          program, "the program printed no configuration: " + to_string(repaired.error()), *end));
    }
    if (repaired->size() != 1) {
      return Unexpected(failure(program, "the program must print one configuration", *end));
    }
    return std::move(repaired->front());
  };
}

}  // namespace swarmsmith
