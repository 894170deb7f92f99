#pragma once

#include <fstream>
#include <string>

namespace swarmsmith {

/// The most memory that this process ever had, MB. Under a sanitizer, which takes several times as
/// much, always 0.
inline double peak_memory() {
#ifndef SWARMSMITH_SANITIZED
  std::ifstream file("/proc/self/status");
  for (std::string word; file >> word;) {
    if (word != "VmHWM:") continue;
    double kilobytes = 0;
    file >> kilobytes;
    return kilobytes / 1024;
  }
#endif
  return 0;
}

}  // namespace swarmsmith
