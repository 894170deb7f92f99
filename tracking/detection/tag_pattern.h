#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/expected.h"

namespace swarmsmith {

/// A tag as cells of black and white, upright, as the apriltag library draws its official images
/// (OpenCV's AprilTags are turned by 180 degrees). A quiet zone of one white cell is part of it.
struct TagPattern {
  int cells = 0;            ///< of a side, quiet zone included
  int border_cells = 0;     ///< between the corners that a detector finds
  std::vector<bool> black;  ///< row by row from the upper left corner

  bool is_black(int row, int column) const {
    const int at = row * cells + column;
    return black[static_cast<std::size_t>(at)];
  }
};

/// For all families of `known_tag_families`. BadInput for a family that is not known, or an id that
/// it has not; with what there is.
Expected<TagPattern> tag_pattern(const std::string& family, int id);

}  // namespace swarmsmith
