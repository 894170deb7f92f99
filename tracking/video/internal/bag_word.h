#pragma once

#include <optional>
#include <string>

namespace swarmsmith {

/// A bag, and which of its topics: `run.bag`, `run.mcap:/camera/image_raw`.
struct BagWord {
  enum class Kind { Ros1, Mcap, Sqlite };
  std::string file;
  std::string topic;  ///< empty: the only one with images
  Kind kind = Kind::Ros1;
};

/// What a word says of a bag; nothing when it means no bag. A bag begins as its format says
/// (`#ROSBAG`, MCAP's magic bytes, SQLite's), or is named .bag, .mcap or .db3. A file that is there
/// wins over a topic, so that names may have colons.
std::optional<BagWord> bag_word(const std::string& word);

}  // namespace swarmsmith
