#include "tracking/video/internal/bag_file.h"
#include "tracking/video/internal/unreadable.h"

namespace swarmsmith {

Expected<std::unique_ptr<FrameSource>> open_bag(const BagWord& word) {
  return unreadable(
      "is a bag of ROS 1, and this program was built without ROS 1; install the Debian package librosbag-storage-dev and "
      "build it again, or convert the bag to MCAP or ROS 2 (`mcap convert`, `rosbags-convert`), which it reads",
      word.file);
}

}  // namespace swarmsmith
