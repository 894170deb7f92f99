#include "tracking/app/commands.h"

#include <array>

namespace swarmsmith::cli {
namespace {

constexpr std::array kCommands = {
    Command{"init", "Write an arena.toml and a run.toml to begin with", "", declare_track_init},
    Command{"check", "Say what an arena has, what is missing and what comes next", "",
            declare_track_check},
    Command{"version", "Print the versions of program and libraries", "", declare_track_version},
};

}  // namespace

std::span<const Command> track_commands() {
  return kCommands;
}

ExitCode exit_code_of_tracking(const Error& error) {
  return error.kind == ErrorKind::BadInput || error.kind == ErrorKind::NotFound ? ExitCode::Usage
                                                                                : ExitCode::Failed;
}

}  // namespace swarmsmith::cli
