#pragma once

#include <span>
#include <string_view>

namespace swarmsmith {

/// A family of AprilTags, with its name in the apriltag library.
struct TagFamily {
  std::string_view name;
  int tags = 0;  ///< number of tags; ids start at 0
};

/// The families that the programs can find, the most common one first.
std::span<const TagFamily> known_tag_families();

}  // namespace swarmsmith
