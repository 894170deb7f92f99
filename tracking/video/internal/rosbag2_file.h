#pragma once

#include <memory>

#include "tracking/video/frame_source.h"
#include "tracking/video/internal/bag_word.h"

namespace swarmsmith {

/// Opens the images of a topic of a ROS 2 bag that is an SQLite file (`run_0.db3`), in the order in
/// which they were recorded.
Expected<std::unique_ptr<FrameSource>> open_rosbag2(const BagWord& word);

}  // namespace swarmsmith
