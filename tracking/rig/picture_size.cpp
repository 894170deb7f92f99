#include "tracking/rig/picture_size.h"

#include <fmt/format.h>

namespace swarmsmith {

Expected<void> check_picture_size(const std::string& model_file, ImageSize calibrated,
                                  ImageSize pictures, const std::vector<std::string>& oddities,
                                  const std::string& where) {
  if (pictures == calibrated) return {};
  std::string text = fmt::format(
      "calibration {}x{}, video {}x{}; film at the picture size of {}, or calibrate the camera "
      "again",
      calibrated.width, calibrated.height, pictures.width, pictures.height, model_file);
  if (pictures.width == calibrated.height && pictures.height == calibrated.width) {
    text +=
        "; its pictures are turned by a quarter: take the file as the camera wrote it, or hold the "
        "camera as for its calibration";
  }
  for (const std::string& oddity : oddities)
    text += "; " + oddity;
  return Unexpected(error_of(IssueCode::CalibrationSize, std::move(text), where));
}

}  // namespace swarmsmith
