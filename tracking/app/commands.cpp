#include "tracking/app/commands.h"

#include <array>

namespace swarmsmith::cli {
namespace {

constexpr std::array kCommands = {
    Command{"record", "Record a camera with the time of each frame",
            "A camera is `camera:0`, `camera:0:1920x1080@30`, an address (`rtsp://...`) or any\n"
            "other word that OpenCV opens (`opencv:WORD`). Beside FILE.mkv stands FILE.times.csv\n"
            "with the time of each frame in seconds from the first one. Ctrl-C ends a recording.\n"
            "What was recorded stays readable whatever happens, all but the last half second.\n\n"
            "  swarmsmith track record camera:0:1920x1080@30 run07.mkv --seconds 130",
            declare_record},
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
