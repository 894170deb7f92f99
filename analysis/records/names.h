#pragma once

#include <string>
#include <string_view>

namespace swarmsmith {

/// Order and form of the names of methods, missions, sources and modules in all figures, tables and
/// sentences.

/// Alphabetical, but the source `real` comes last, so that differences are simulation minus
/// reality.
struct NameOrder {
  bool operator()(std::string_view a, std::string_view b) const;
};

/// "color_selection" in words: "color selection".
std::string as_words(std::string name);

}  // namespace swarmsmith
