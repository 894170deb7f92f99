#pragma once

#include <string>
#include <vector>

#include "analysis/arena/arena_picture.h"

namespace swarmsmith {

/// Runs from above, side by side and below each other.
struct ArenaPanels {
  std::string title;
  std::vector<std::string> details;    ///< below it, a line each
  std::vector<ArenaPicture> pictures;  ///< their widths are not used
  double width_mm = 84;
};

/// As SVG: as many pictures in a row as are at least kLeastPictureWidth_mm wide.
std::string draw(const ArenaPanels& panels);

}  // namespace swarmsmith
