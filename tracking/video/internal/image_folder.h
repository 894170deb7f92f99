#pragma once

#include <memory>
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

}  // namespace swarmsmith
