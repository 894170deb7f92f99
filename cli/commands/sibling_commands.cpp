#include <unistd.h>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "base/program_path.h"
#include "cli/commands/commands.h"

namespace swarmsmith::cli {
namespace {

/// Replaces this process by the program; prints `missing` if it does not exist.
ExitCode become(std::string program, const std::vector<std::string>& words,
                const std::string& missing, Output& output) {
  std::error_code trouble;
  if (!std::filesystem::exists(program, trouble))
    return fail(output, ExitCode::Unreachable, program + " is not installed: " + missing);
  std::vector<std::string> copies(words);
  std::vector<char*> pointers{program.data()};
  for (std::string& word : copies)
    pointers.push_back(word.data());
  pointers.push_back(nullptr);
  execv(program.c_str(), pointers.data());
  return fail(output, ExitCode::Unreachable,
              program + " cannot be started: " + std::strerror(errno));
}

}  // namespace

ExitCode run_track(const std::vector<std::string>& words, Output& output) {
  return become(sibling_program("SWARMSMITH_TRACK", "swarmsmith-track").string(), words,
                "it is built where OpenCV, libapriltag and FFmpeg's libraries are (Debian: "
                "libopencv-contrib-dev libapriltag-dev libavformat-dev libavcodec-dev "
                "libswscale-dev); `./dev build` installs them",
                output);
}

ExitCode run_robot(const std::vector<std::string>& words, Output& output) {
  return become(sibling_program("SWARMSMITH_ROBOT", "swarmsmith-robot").string(), words,
                "`./dev build` makes it; for ROS it needs libroscpp-dev libstd-msgs-dev "
                "libsensor-msgs-dev libgeometry-msgs-dev (Debian)",
                output);
}

}  // namespace swarmsmith::cli
