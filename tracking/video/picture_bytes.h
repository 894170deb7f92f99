#pragma once

#include <string>

#include "base/expected.h"
#include "tracking/video/frame_source.h"

namespace swarmsmith {

/// A picture as the bytes of a file. Unavailable with the encoder's message.
Expected<std::string> png_of(const ColorImage& image);
Expected<std::string> jpeg_of(const ColorImage& image, int quality);  ///< 1 to 100

}  // namespace swarmsmith
