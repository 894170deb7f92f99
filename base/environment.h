#pragma once

#include <cstdlib>
#include <string>

namespace swarmsmith {

/// The environment variable; `unset` where there is none.
inline std::string environment(const char* name, const char* unset = "") {
  const char* value = std::getenv(name);
  return value == nullptr ? unset : value;
}

}  // namespace swarmsmith
