#include <unistd.h>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "base/program_path.h"
#include "cli/commands/commands.h"

namespace swarmsmith::cli {

ExitCode run_track(const std::vector<std::string>& words, Output& output) {
  std::string program = sibling_program("SWARMSMITH_TRACK", "swarmsmith-track").string();
  std::error_code trouble;
  if (!std::filesystem::exists(program, trouble)) {
    return fail(
        output, ExitCode::Unreachable,
        program +
            " is not there: it is built where OpenCV, libapriltag and FFmpeg's libraries "
            "are (Debian: libopencv-contrib-dev libapriltag-dev libavformat-dev "
            "libavcodec-dev libswscale-dev librosbag-storage-dev); `./dev build` installs them");
  }
  std::vector<std::string> copies(words);
  std::vector<char*> pointers{program.data()};
  for (std::string& word : copies)
    pointers.push_back(word.data());
  pointers.push_back(nullptr);
  execv(program.c_str(), pointers.data());
  return fail(output, ExitCode::Unreachable,
              program + " cannot be started: " + std::strerror(errno));
}

}  // namespace swarmsmith::cli
