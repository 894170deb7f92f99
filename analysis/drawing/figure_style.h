#pragma once

#include <string>
#include <string_view>

#include "analysis/drawing/svg.h"

namespace swarmsmith {

/// Sizes that all figures share, mm on the page.
inline constexpr double kMargin = 2;
inline constexpr double kTitleSize = 3.4;
inline constexpr double kTextSize = 2.8;
inline constexpr double kBolder = 1.15;  ///< bold text is wider by this factor
inline constexpr double kLineHeight = 4.2;
inline constexpr std::string_view kInk = "#222222";

inline TextStyle ink(TextStyle::Anchor anchor, double size = kTextSize) {
  return {.size = size, .anchor = anchor, .fill = std::string(kInk)};
}

}  // namespace swarmsmith
