#pragma once

#include <span>
#include <string_view>

namespace swarmsmith {

/// A family of AprilTags, by the name that its library gives it.
struct TagFamily {
  std::string_view name;
  int tags = 0;  ///< they are numbered from 0
};

/// Those that the programs can find, the usual one first.
std::span<const TagFamily> known_tag_families();

}  // namespace swarmsmith
