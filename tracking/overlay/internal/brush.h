#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <string>
#include <vector>

#include "sim/control/reference_model.h"
#include "tracking/geometry/view.h"
#include "tracking/video/frame_source.h"

namespace swarmsmith {

/// Draws on a picture with lines and text that fit its size. Lines have a dark rim, so that they
/// are visible on any floor.
class Brush {
 public:
  explicit Brush(ColorImage& image);

  /// The image of a line through points of the world; long pieces are divided, so that they follow
  /// the distortion of the lens.
  static std::vector<cv::Point2d> seen(const View& view, std::span<const Point3> points,
                                       bool closed);
  void line(const std::vector<cv::Point2d>& points, Rgb color, double width, bool closed);
  /// A thin closed line without a rim.
  void hairline(const std::vector<cv::Point2d>& points, Rgb color);
  /// Fills shapes; a share is the opacity of a shape, and 1 hides everything below.
  void fill(const std::vector<std::vector<cv::Point2d>>& shapes, Rgb color,
            std::span<const double> shares);
  void cross(cv::Point2d at, Rgb color, double size, double width);

  /// A text in a dark box with its lower left corner at `at`, moved if necessary to be inside the
  /// picture.
  void label(cv::Point2d at, const std::string& text, Rgb color);
  /// Lines of text in one dark box in the upper or lower left corner, cut off at the right edge.
  void panel(const std::vector<std::string>& lines, Rgb color, bool at_top);
  /// Small text without a box, centred at `middle`.
  void note(cv::Point2d middle, const std::string& text, Rgb color);

  double scale() const { return scale_; }

 private:
  cv::Mat picture_;
  double scale_;  ///< 1 for a picture with 1080 rows
};

}  // namespace swarmsmith
