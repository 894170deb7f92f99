#include "tests/support/film/cell_picture.h"

#include <apriltag/apriltag.h>
#include <apriltag/tag16h5.h>
#include <apriltag/tag25h9.h>
#include <apriltag/tag36h11.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

namespace swarmsmith::film {
namespace {

struct Family {
  const char* name;
  apriltag_family_t* (*create)();
  void (*destroy)(apriltag_family_t*);
};

constexpr Family kFamilies[] = {{"tag36h11", tag36h11_create, tag36h11_destroy},
                                {"tag25h9", tag25h9_create, tag25h9_destroy},
                                {"tag16h5", tag16h5_create, tag16h5_destroy}};

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
  for (const Family& known : kFamilies) {
    if (family != known.name) continue;
    const std::unique_ptr<apriltag_family_t, void (*)(apriltag_family_t*)> codes(known.create(),
                                                                                 known.destroy);
    if (tag < 0 || static_cast<std::uint32_t>(tag) >= codes->ncodes)
      throw std::invalid_argument(family + " has no tag " + std::to_string(tag));
    // Debian's library does not export image_u8_destroy, which is these two lines.
    const auto release = [](image_u8_t* image) {
      std::free(image->buf);
      std::free(image);
    };
    const std::unique_ptr<image_u8_t, decltype(release)> image(apriltag_to_image(codes.get(), tag),
                                                               release);
    CellPicture picture;
    picture.width = image->width;
    picture.height = image->height;
    picture.border = (codes->total_width - codes->width_at_border) / 2;
    for (int row = 0; row < picture.height; ++row) {
      const std::uint8_t* from = image->buf + static_cast<std::ptrdiff_t>(row) * image->stride;
      picture.gray.insert(picture.gray.end(), from, from + picture.width);
    }
    return picture;
  }
  throw std::invalid_argument("no tag family " + family);
}

}  // namespace swarmsmith::film
