#pragma once

#include <memory>

#include "tracking/video/frame_source.h"
#include "tracking/video/internal/bag_word.h"

namespace swarmsmith {

/// Opens the images of a topic in a bag (ROS 1, format 2.0): sensor_msgs/Image, and
/// sensor_msgs/CompressedImage as PNG or JPEG, in the order in which they were recorded. Only one
/// chunk of the bag is in memory at a time. Times are those in the messages' headers, in seconds
/// since 1970; if the first image has no time, they are the times of recording. An image that
/// cannot be read counts as damaged. E_CONFIG if the topic does not exist, or if none is given and
/// there are several.
Expected<std::unique_ptr<FrameSource>> open_bag(const BagWord& word);

}  // namespace swarmsmith
