#include "tracking/video/other_size.h"

namespace swarmsmith {

std::string why_other_size(const SourceInfo& info, ImageSize calibrated) {
  std::string text;
  if (info.size.width == calibrated.height && info.size.height == calibrated.width) {
    text +=
        "; its pictures are turned by a quarter: take the file as the camera wrote it, or hold the "
        "camera as for its calibration";
  }
  for (const std::string& oddity : info.oddities)
    text += "; " + oddity;
  return text;
}

}  // namespace swarmsmith
