#include "tests/support/film/cell_picture.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tracking/detection/tag_pattern.h"

namespace swarmsmith::film {
namespace {

/// The two cells that an opening reaches, and the share of the second.
struct Span {
  int first;
  int second;
  float share;
};

Span span_at(float place, float opening, int count) {
  const float from_middle = place - 0.5F;
  const float base = std::floor(from_middle);
  const float share = std::clamp((from_middle - base - 0.5F) / opening + 0.5F, 0.0F, 1.0F);
  const int cell = static_cast<int>(base);
  return {std::clamp(cell, 0, count - 1), std::clamp(cell + 1, 0, count - 1), share};
}

}  // namespace

float CellPicture::at(float column, float row, float opening) const {
  const Span x = span_at(column, opening, width);
  const Span y = span_at(row, opening, height);
  const std::uint8_t* upper = gray.data() + static_cast<std::ptrdiff_t>(y.first) * width;
  const std::uint8_t* lower = gray.data() + static_cast<std::ptrdiff_t>(y.second) * width;
  const float a = static_cast<float>(upper[x.first]) * (1 - x.share) +
                  static_cast<float>(upper[x.second]) * x.share;
  const float b = static_cast<float>(lower[x.first]) * (1 - x.share) +
                  static_cast<float>(lower[x.second]) * x.share;
  return a * (1 - y.share) + b * y.share;
}

CellPicture tag_picture(const std::string& family, int tag) {
  const auto pattern = tag_pattern(family, tag);
  if (!pattern) throw std::invalid_argument(to_string(pattern.error()));
  CellPicture picture;
  picture.width = pattern->cells;
  picture.height = pattern->cells;
  picture.border = (pattern->cells - pattern->border_cells) / 2;
  for (const bool black : pattern->black)
    picture.gray.push_back(black ? 0 : 255);
  return picture;
}

}  // namespace swarmsmith::film
