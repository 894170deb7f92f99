#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace swarmsmith::film {

/// A picture of square cells, seen through a square opening: what tags and boards are made of.
struct CellPicture {
  int width = 0;
  int height = 0;
  int border = 0;  ///< cells of white around a tag's black border
  std::vector<std::uint8_t> gray;

  /// Brightness at a place in cells from the upper left corner, averaged over a square of
  /// `opening` cells (at most 1).
  float at(float column, float row, float opening) const;
};

/// The official picture of a tag, upright, with its white quiet zone (apriltag_to_image; not
/// OpenCV's, which is turned by half a circle). Throws std::invalid_argument for a family or a
/// number that is not there.
CellPicture tag_picture(const std::string& family, int tag);

}  // namespace swarmsmith::film
