#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "tracking/video/frame_source.h"

namespace swarmsmith {

/// A video file. Reads it twice: first its packets alone, for the number of frames, the time of
/// each, and whether the end is missing; then the pictures.
Expected<std::unique_ptr<FrameSource>> open_video_file(const std::string& path);

/// The same over bytes in memory, which must outlive it.
Expected<std::unique_ptr<FrameSource>> open_video_bytes(std::string_view bytes,
                                                        const std::string& name);

}  // namespace swarmsmith
