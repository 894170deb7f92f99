#include "tracking/app/commands.h"

#include <array>

namespace swarmsmith::cli {
namespace {

constexpr std::array kCommands = {
    Command{"version", "Print the versions of program and libraries", "", declare_track_version},
};

}  // namespace

std::span<const Command> track_commands() {
  return kCommands;
}

ExitCode exit_code_of_tracking(const Error& error) {
  return error.kind == ErrorKind::BadInput ? ExitCode::Usage : ExitCode::Failed;
}

}  // namespace swarmsmith::cli
