#pragma once

#include <optional>
#include <string>

namespace swarmsmith {

/// A bag and one of its topics: `run.bag`, `run.mcap:/camera/image_raw`.
struct BagWord {
  enum class Kind { Ros1, Mcap, Sqlite };
  std::string file;
  std::string topic;  ///< empty: the only topic with images
  Kind kind = Kind::Ros1;
};

/// Parses the text that names a bag; nothing if it does not. A file is a bag if it begins with the
/// mark of its format (`#ROSBAG`, MCAP's magic bytes, SQLite's), or if its name ends in .bag, .mcap
/// or .db3. An existing file takes precedence over a topic, so that file names may contain colons.
std::optional<BagWord> bag_word(const std::string& word);

}  // namespace swarmsmith
