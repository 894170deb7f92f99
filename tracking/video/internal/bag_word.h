#pragma once

#include <optional>
#include <string>

namespace swarmsmith {

/// A bag of ROS 1, and which of its topics: `run.bag`, `run.bag:/camera/image_raw`.
struct BagWord {
  std::string file;
  std::string topic;  ///< empty: the only one with images
};

/// What a word says of a bag; nothing when it means no bag. A bag begins with `#ROSBAG`, or is
/// named .bag. A file that is there wins over a topic, so that names may have colons.
std::optional<BagWord> bag_word(const std::string& word);

}  // namespace swarmsmith
