#pragma once

#include <memory>
#include <optional>
#include <string>

#include "tracking/video/frame_source.h"

namespace swarmsmith {

/// Opens a folder of pictures (PNG, JPEG, BMP, TIFF, PGM, PPM), in the natural order of their
/// names. Orientation tags of photographs are ignored: pixels are in the order of the sensor, as in
/// videos.
Expected<std::unique_ptr<FrameSource>> open_image_folder(const std::string& path);

/// Whether a path is a file with the extension of a picture.
bool is_image_file(const std::string& path);
/// Opens a single picture, like a folder with one picture.
Expected<std::unique_ptr<FrameSource>> open_image(const std::string& path);

/// The time in a picture's file name, in seconds since 1970, if there is one: "1732391823.25.png",
/// "frame-1732391823250.png" (milliseconds; microseconds and nanoseconds have 16 and 19 digits),
/// "1732391823-250000000.png" (seconds and nanoseconds, as in ROS).
std::optional<double> time_in_name(const std::string& file);

}  // namespace swarmsmith
