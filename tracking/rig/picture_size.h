#pragma once

#include <string>
#include <vector>

#include "tracking/geometry/camera_model.h"
#include "tracking/rig/issue.h"

namespace swarmsmith {

/// E_CALIB_SIZE if the pictures have another size than the lens calibration in `model_file`, with
/// the reason as far as it is known. `oddities` are notes about the film.
Expected<void> check_picture_size(const std::string& model_file, ImageSize calibrated,
                                  ImageSize pictures, const std::vector<std::string>& oddities,
                                  const std::string& where);

}  // namespace swarmsmith
