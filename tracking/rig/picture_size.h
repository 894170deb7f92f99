#pragma once

#include <string>
#include <vector>

#include "tracking/geometry/camera_model.h"
#include "tracking/rig/issue.h"

namespace swarmsmith {

/// E_CALIB_SIZE for pictures of another size than the lens calibration in `model_file` is for, with
/// the reason, as far as it can be known. `oddities` are those of their film.
Expected<void> check_picture_size(const std::string& model_file, ImageSize calibrated,
                                  ImageSize pictures, const std::vector<std::string>& oddities,
                                  const std::string& where);

}  // namespace swarmsmith
