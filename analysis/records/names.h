#pragma once

#include <string>
#include <string_view>

namespace swarmsmith {

/// How names of methods, missions, sources and modules are ordered and shown, in every figure,
/// table and sentence.

/// By the letters, the source `real` last, since differences are those of simulation to reality.
struct NameOrder {
  bool operator()(std::string_view a, std::string_view b) const;
};

/// "color_selection" as people write it: "color selection".
std::string as_words(std::string name);

}  // namespace swarmsmith
