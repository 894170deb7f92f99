#pragma once

#include <memory>
#include <optional>
#include <string>

#include "tracking/video/frame_source.h"

namespace swarmsmith {

/// A folder of pictures (PNG, JPEG, BMP, TIFF, PGM, PPM), in the natural order of their names.
/// Turning marks of photographs are left alone: pixels are as the sensor gave them, as in videos.
Expected<std::unique_ptr<FrameSource>> open_image_folder(const std::string& path);

/// Whether a name is that of a picture, by its ending, and a file.
bool is_image_file(const std::string& path);
/// A single picture, as a folder of one.
Expected<std::unique_ptr<FrameSource>> open_image(const std::string& path);

/// The time since 1970, seconds, when a picture's name is one: "1732391823.25.png",
/// "frame-1732391823250.png" (milliseconds; microseconds and nanoseconds have 16 and 19 digits),
/// "1732391823-250000000.png" (seconds and nanoseconds, as ROS has them).
std::optional<double> time_in_name(const std::string& file);

}  // namespace swarmsmith
