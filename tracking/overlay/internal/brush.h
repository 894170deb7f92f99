#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <string>
#include <vector>

#include "sim/control/reference_model.h"
#include "tracking/geometry/view.h"
#include "tracking/video/frame_source.h"

namespace swarmsmith {

/// Draws on a picture with lines and letters that fit its size; lines have a dark rim, so that
/// they can be seen on any floor.
class Brush {
 public:
  explicit Brush(ColorImage& image);

  /// Points of the world as a line on the picture; long pieces bend as the lens bends them.
  static std::vector<cv::Point2d> seen(const View& view, std::span<const Point3> points,
                                       bool closed);
  void line(const std::vector<cv::Point2d>& points, Rgb color, double width, bool closed);
  /// Thin, closed, without a rim.
  void hairline(const std::vector<cv::Point2d>& points, Rgb color);
  /// `share`: 1 hides what is below.
  void fill(const std::vector<std::vector<cv::Point2d>>& shapes, Rgb color,
            std::span<const double> shares);
  void cross(cv::Point2d at, Rgb color, double size, double width);

  /// A text in a dark box; where its lower left corner is, moved into the picture.
  void label(cv::Point2d at, const std::string& text, Rgb color);
  /// Lines of text in one dark box in the upper or lower left corner, cut at the right edge.
  void panel(const std::vector<std::string>& lines, Rgb color, bool at_top);
  /// Small, without a box, about its middle.
  void note(cv::Point2d middle, const std::string& text, Rgb color);

  double scale() const { return scale_; }

 private:
  cv::Mat picture_;
  double scale_;  ///< 1 for a height of 1080
};

}  // namespace swarmsmith
