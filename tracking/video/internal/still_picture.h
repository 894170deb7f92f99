#pragma once

#include <string>

#include "base/expected.h"
#include "tracking/video/internal/av.h"

namespace swarmsmith::av {

/// A picture of the bytes of a whole file: PNG, JPEG, BMP, TIFF, PGM or PPM, by what they begin
/// with. E_VIDEO_UNREADABLE for others, and for damaged ones.
Expected<FramePtr> decode_still(const AVPacket& bytes, const std::string& name);

}  // namespace swarmsmith::av
