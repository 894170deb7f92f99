#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tracking/detection/tag_detector.h"

namespace swarmsmith {

/// A tag to be painted, with the corners of its border as the apriltag library orders them.
struct PaintedTag {
  int tag = 0;
  TagCorners corners{};
};

/// How a picture falls short.
struct Shortcomings {
  double blur_px = 0.7;  ///< sigma
  double noise = 2;      ///< sigma, grey levels
  double black = 30;
  double white = 200;
  double floor = 120;
};

/// A picture that owns its pixels.
struct PaintedPicture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;

  GrayImage gray() const { return {pixels.data(), width, height, width}; }
};

/// Corners of a square tag about a middle; `turned_rad` counter-clockwise as seen on paper.
TagCorners square_corners(double u, double v, double edge_px, double turned_rad);

/// Official tag images, as the library draws them, put at their corners with four times the
/// picture's resolution; the same seed gives the same noise.
PaintedPicture painted(int width, int height, const std::string& family,
                       const std::vector<PaintedTag>& tags, const Shortcomings& shortcomings = {},
                       std::uint64_t seed = 1);

}  // namespace swarmsmith
