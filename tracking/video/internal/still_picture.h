#pragma once

#include <string>

#include "base/expected.h"
#include "tracking/video/internal/av.h"

namespace swarmsmith::av {

/// Decodes the bytes of a whole picture file: PNG, JPEG, BMP, TIFF, PGM or PPM, recognised by its
/// first bytes. E_VIDEO_UNREADABLE for other files and for damaged ones.
Expected<FramePtr> decode_still(const AVPacket& bytes, const std::string& name);

}  // namespace swarmsmith::av
