#pragma once

#include <memory>

#include "tracking/video/frame_source.h"
#include "tracking/video/internal/bag_word.h"

namespace swarmsmith {

/// The images of a topic of a bag (ROS 1, format 2.0): sensor_msgs/Image and, as PNG or JPEG,
/// sensor_msgs/CompressedImage, in the order in which they were recorded. One chunk of the bag is
/// in memory at a time. Times are those of the messages' headers, seconds since 1970; of a bag
/// whose first image has none, when each was recorded. An image that cannot be read is damaged.
/// E_CONFIG for a topic that is not there, and for none among several.
Expected<std::unique_ptr<FrameSource>> open_bag(const BagWord& word);

}  // namespace swarmsmith
