#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace swarmsmith {

/// The source of a camera's frame times, best first.
enum class TimeSource { Sidecar, Container, FrameRate };

inline std::string_view name_of(TimeSource source) {
  constexpr std::array<std::string_view, 3> kNames = {"sidecar", "container", "frame rate"};
  return kNames.at(static_cast<std::size_t>(source));
}

}  // namespace swarmsmith
