#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "tracking/video/frame_source.h"

namespace swarmsmith {

/// Opens a video file. The file is read twice: first only its packets, for the number of frames,
/// their times, and whether the end is missing; then the pictures.
Expected<std::unique_ptr<FrameSource>> open_video_file(const std::string& path);

/// The same for bytes in memory, which must outlive the source.
Expected<std::unique_ptr<FrameSource>> open_video_bytes(std::string_view bytes,
                                                        const std::string& name);

}  // namespace swarmsmith
