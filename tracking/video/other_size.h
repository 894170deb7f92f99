#pragma once

#include <string>

#include "tracking/video/frame_source.h"

namespace swarmsmith {

/// Why a film is not as large as its camera's calibration, as far as it can be known: "; ...".
std::string why_other_size(const SourceInfo& info, ImageSize calibrated);

}  // namespace swarmsmith
