#pragma once

#include <cstdlib>
#include <string>

namespace swarmsmith {

/// The value of the environment variable; `unset` if it does not exist.
inline std::string environment(const char* name, const char* unset = "") {
  const char* value = std::getenv(name);
  return value == nullptr ? unset : value;
}

}  // namespace swarmsmith
