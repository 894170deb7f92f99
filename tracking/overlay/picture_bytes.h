#pragma once

#include <string>

#include "tracking/video/frame_source.h"

namespace swarmsmith {

/// A picture as the bytes of a file.
std::string png_of(const ColorImage& image);
std::string jpeg_of(const ColorImage& image, int quality);  ///< 1 to 100

}  // namespace swarmsmith
