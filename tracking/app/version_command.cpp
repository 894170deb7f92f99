#include <opencv2/core/version.hpp>

#include "tracking/app/commands.h"

extern "C" {
#include <libavformat/version.h>
}

namespace swarmsmith::cli {

std::string track_program_name() {
  return "swarmsmith-track " SWARMSMITH_VERSION ", OpenCV " CV_VERSION
         ", apriltag " SWARMSMITH_APRILTAG ", libavformat " AV_STRINGIFY(LIBAVFORMAT_VERSION);
}

Run declare_track_version(Options&) {
  return [](Output& output) {
    if (output.json) {
      output.out << "{\"name\":\"swarmsmith-track\",\"version\":" << json_text(SWARMSMITH_VERSION)
                 << ",\"opencv\":" << json_text(CV_VERSION)
                 << ",\"apriltag\":" << json_text(SWARMSMITH_APRILTAG)
                 << ",\"libavformat\":" << json_text(AV_STRINGIFY(LIBAVFORMAT_VERSION)) << "}\n";
    } else {
      output.out << track_program_name() << "\n";
    }
    return ExitCode::Done;
  };
}

}  // namespace swarmsmith::cli
