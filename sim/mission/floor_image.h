#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "sim/control/reference_model.h"
#include "sim/mission/pose.h"

namespace swarmsmith {

/// Pixels of a PNG file, read once and then shared by all copies of an arena.
class Picture {
 public:
  static constexpr std::size_t kMostBytes = 1U << 20U;
  static constexpr std::int64_t kMostPixels = 16'000'000;
  /// Limit for all pictures of a process together; the same file is decoded only once.
  static constexpr std::int64_t kMostPixelsInUse = 32'000'000;

  /// Reads the bytes of a PNG file with any kind of pixels and converts them to 8-bit sRGB. It is
  /// an error if the file is larger than a megabyte or 16 million pixels, is not a PNG, or would
  /// make the pictures in use larger than `most_in_use` pixels together.
  static Expected<std::shared_ptr<const Picture>> from_png(
      std::string bytes, std::int64_t most_in_use = kMostPixelsInUse);

  int width() const { return width_; }
  int height() const { return height_; }
  /// Column from the left, row from the top. Nothing where the picture is at least half
  /// transparent.
  std::optional<Rgb> at(int column, int row) const;
  /// The bytes of the PNG file.
  const std::string& png() const { return png_; }

 private:
  Picture() = default;

  int width_ = 0;
  int height_ = 0;
  std::vector<std::uint8_t> pixels_;  ///< red, green, blue, opacity; row by row from the top
  std::string png_;
};

/// Finds the pixel at a point of the floor, for a picture that covers a rectangle.
///
/// The picture's top row is at the largest y. A point has the colour of the pixel in which it lies;
/// a point on the border between two pixels has the colour of the right or lower one. The border of
/// the rectangle belongs to the picture.
std::optional<Rgb> pixel_at(const Picture& picture, Point top_left, double width_m, double height_m,
                            Point point);

}  // namespace swarmsmith
