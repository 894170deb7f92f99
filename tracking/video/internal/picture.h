#pragma once

#include <vector>

#include "tracking/video/frame_source.h"
#include "tracking/video/internal/av.h"

namespace swarmsmith::av {

/// Whether pictures of this size are accepted for reading and writing; and the same with a reason.
bool is_taken(int width, int height, std::int64_t most_pixels = kMostPixels);
Expected<void> check_size(int width, int height, const std::string& where,
                          std::int64_t most_pixels = kMostPixels);

/// Gives the brightness and colours of decoded pictures. Keeps its scalers from picture to picture.
class Pictures {
 public:
  /// The brightness of a picture. If the picture has an 8-bit plane of brightness, this plane is
  /// returned; it is valid as long as `frame`. Its video range (16 to 235) is not stretched,
  /// because the detector only compares neighbouring pixels, and stretching would round every pixel
  /// again. Other formats are converted into a buffer of this object. Nothing if the format cannot
  /// be read.
  std::optional<GrayImage> gray(const AVFrame& frame);
  /// The colours in full range, with the colour matrix that the picture specifies.
  ColorImage color(const AVFrame& frame);

 private:
  Scaler to_gray_;
  Scaler to_color_;
  std::vector<std::uint8_t> gray_;
};

/// Converts BGR to the planes of a full-range YUV frame, by BT.601, so that its brightness is the
/// same as OpenCV's.
void fill(AVFrame& frame, const ColorImage& image, Scaler& kept);
/// Fills in the brightness, without colour.
void fill(AVFrame& frame, const GrayImage& image);

}  // namespace swarmsmith::av
