#pragma once

#include <vector>

#include "tracking/video/frame_source.h"
#include "tracking/video/internal/av.h"

namespace swarmsmith::av {

/// Whether pictures of this size are read and written; and a sentence why not.
bool is_taken(int width, int height, std::int64_t most_pixels = kMostPixels);
Expected<void> check_size(int width, int height, const std::string& where,
                          std::int64_t most_pixels = kMostPixels);

/// Brightness and colours of decoded pictures. Keeps its scalers from picture to picture.
class Pictures {
 public:
  /// The brightness. Where the picture has a plane of it with 8 bits, that plane itself, which
  /// lives as long as `frame`: video range (16 to 235) is not stretched, since the detector only
  /// compares neighbours, and stretching would round every pixel again. Other formats are
  /// converted, into a buffer of this object. Nothing when the format cannot be read.
  std::optional<GrayImage> gray(const AVFrame& frame);
  /// In the full range, by the colour matrix that the picture names.
  ColorImage color(const AVFrame& frame);

 private:
  Scaler to_gray_;
  Scaler to_color_;
  std::vector<std::uint8_t> gray_;
};

/// BGR into the planes of a YUV frame of the full range, by BT.601, so that its brightness is what
/// OpenCV takes for it.
void fill(AVFrame& frame, const ColorImage& image, Scaler& kept);
/// The brightness, and no colour.
void fill(AVFrame& frame, const GrayImage& image);

}  // namespace swarmsmith::av
