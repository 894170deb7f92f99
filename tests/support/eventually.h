#pragma once

#include <chrono>
#include <thread>

namespace swarmsmith {

/// Looks again and again until `holds()`; false when it still does not after a minute, which is far
/// longer than a slow machine takes. `between()` runs between two looks: what must go on meanwhile.
template <class Holds, class Between>
bool eventually(const Holds& holds, const Between& between) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!holds()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    between();
  }
  return true;
}

template <class Holds>
bool eventually(const Holds& holds) {
  return eventually(holds, [] { std::this_thread::sleep_for(std::chrono::milliseconds(1)); });
}

}  // namespace swarmsmith
