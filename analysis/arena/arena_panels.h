#pragma once

#include <string>
#include <vector>

#include "analysis/arena/arena_picture.h"

namespace swarmsmith {

/// Several runs from above in one figure, in rows.
struct ArenaPanels {
  std::string title;
  std::vector<std::string> details;    ///< below the title, one per line
  std::vector<ArenaPicture> pictures;  ///< their widths are not used
  double width_mm = 84;
};

/// The figure as SVG. A row has as many pictures as fit with a width of at least
/// kLeastPictureWidth_mm.
std::string draw(const ArenaPanels& panels);

}  // namespace swarmsmith
