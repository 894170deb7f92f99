#include <opencv2/core/version.hpp>

#include "base/text/json.h"
#include "tracking/app/commands.h"

extern "C" {
#include <libavformat/version.h>
}

namespace swarmsmith {

std::string track_program_name() {
  return "swarmsmith-track " SWARMSMITH_VERSION ", OpenCV " CV_VERSION
         ", apriltag " SWARMSMITH_APRILTAG ", libavformat " AV_STRINGIFY(LIBAVFORMAT_VERSION);
}

CommandRun declare_track_version(Options&) {
  return [](Output& output) {
    if (output.json) {
      output.out << JsonObject()
                        .add("name", "swarmsmith-track")
                        .add("version", SWARMSMITH_VERSION)
                        .add("opencv", CV_VERSION)
                        .add("apriltag", SWARMSMITH_APRILTAG)
                        .add("libavformat", AV_STRINGIFY(LIBAVFORMAT_VERSION))
                        .text()
                 << "\n";
    } else {
      output.out << track_program_name() << "\n";
    }
    return ExitCode::Done;
  };
}

}  // namespace swarmsmith
