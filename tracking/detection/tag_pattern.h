#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/expected.h"

namespace swarmsmith {

/// A tag as black and white cells, upright, as in the official images of the apriltag library
/// (OpenCV's AprilTags are turned by 180 degrees). It includes a quiet zone of one white cell.
struct TagPattern {
  int cells = 0;            ///< per side, including the quiet zone
  int border_cells = 0;     ///< cells between the corners that a detector finds
  std::vector<bool> black;  ///< row by row from the upper left corner

  bool is_black(int row, int column) const {
    const int at = row * cells + column;
    return black[static_cast<std::size_t>(at)];
  }
};

/// The pattern of a tag of any family in `known_tag_families`. BadInput for an unknown family, or
/// an id that the family does not have; the error lists the valid ones.
Expected<TagPattern> tag_pattern(const std::string& family, int id);

}  // namespace swarmsmith
