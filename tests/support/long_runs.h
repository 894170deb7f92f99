#pragma once

#include <cstdlib>
#include <string_view>

namespace swarmsmith {

/// How often a test does what it does: `usual` in the tests of each commit, `all` in `./dev test
/// --long`, which sets SWARMSMITH_LONG to 1 and runs the programs that are WIDE once more.
template <class Count>
Count times(Count usual, Count all) {
  const char* wanted = std::getenv("SWARMSMITH_LONG");
  return wanted != nullptr && std::string_view(wanted) == "1" ? all : usual;
}

}  // namespace swarmsmith
