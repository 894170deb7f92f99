#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "analysis/drawing/svg.h"
#include "analysis/machines/machine_layout.h"

namespace swarmsmith {

/// Colours and dashes of states, for all three formats of a picture.

inline constexpr double kEdgeWidth = 0.35;
inline constexpr double kStateWidth = 0.45;
inline constexpr std::string_view kPaper = "#ffffff";

inline std::string state_color(std::size_t state) {
  return distinct_color(state);
}

inline std::string state_fill(std::size_t state) {
  return lightened(state_color(state), 0.88);
}

/// A state that cannot be reached is grey, and so are its transitions.
inline std::string color_of(const MachineLayout& layout, std::size_t state) {
  return layout.states[state].reachable ? state_color(state) : "#b4b4b4";
}

inline std::string fill_of(const MachineLayout& layout, std::size_t state) {
  return layout.states[state].reachable ? state_fill(state) : "#f6f6f6";
}

inline constexpr std::string_view kGreyText = "#6b6b6b";

/// Lengths of dashes and gaps, mm; empty for a solid line.
inline std::string_view state_dashes(std::size_t state) {
  constexpr std::string_view kDashes[] = {"", "2 0.8", "0.7 0.6", "2.4 0.6 0.6 0.6"};
  return kDashes[state % 4];
}

}  // namespace swarmsmith
