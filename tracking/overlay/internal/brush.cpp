#include "tracking/overlay/internal/brush.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace swarmsmith {
namespace {

constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr double kFontSize = 0.7;
constexpr double kNoteSize = 0.42;
constexpr double kPiece_m = 0.05;
/// Number of fractional bits for pixels in OpenCV's drawing functions: steps of 1/16.
constexpr int kShift = 4;
const cv::Scalar kRim(25, 25, 25);

cv::Scalar scalar_of(Rgb color) {
  return {static_cast<double>(color.b), static_cast<double>(color.g), static_cast<double>(color.r)};
}

cv::Point fine(cv::Point2d point) {
  // Far outside the picture, OpenCV's fixed-point numbers would overflow.
  const auto clamped = [](double x) { return std::clamp(x, -10'000.0, 20'000.0); };
  return {cvRound(clamped(point.x) * (1 << kShift)), cvRound(clamped(point.y) * (1 << kShift))};
}

std::vector<cv::Point> fine(const std::vector<cv::Point2d>& points) {
  std::vector<cv::Point> result;
  result.reserve(points.size());
  for (const cv::Point2d& point : points)
    result.push_back(fine(point));
  return result;
}

std::string cut(std::string text, double font, int most_px) {
  const auto width = [&](const std::string& of) {
    return cv::getTextSize(of, kFont, font, 1, nullptr).width;
  };
  if (width(text) <= most_px) return text;
  while (!text.empty() && width(text + "...") > most_px)
    text.pop_back();
  return text + "...";
}

}  // namespace

Brush::Brush(ColorImage& image)
    : picture_(image.height, image.width, CV_8UC3, image.bgr.data()),
      scale_(std::max(0.55, image.height / 1080.0)) {}

std::vector<cv::Point2d> Brush::seen(const View& view, std::span<const Point3> points,
                                     bool closed) {
  std::vector<cv::Point2d> line;
  const auto add = [&](const Point3& world) {
    if (view.place.seen_from_camera(world).z <= 0.05) return;
    const ImagePoint at = image_of(view, world);
    line.emplace_back(at.u, at.v);
  };
  const std::size_t pieces = closed || points.empty() ? points.size() : points.size() - 1;
  for (std::size_t i = 0; i < pieces; ++i) {
    const Point3& from = points[i];
    const Point3& to = points[(i + 1) % points.size()];
    const double length = std::hypot(to.x - from.x, std::hypot(to.y - from.y, to.z - from.z));
    const int steps = std::max(1, static_cast<int>(std::ceil(length / kPiece_m)));
    for (int step = 0; step < steps; ++step) {
      const double share = static_cast<double>(step) / steps;
      add({from.x + share * (to.x - from.x), from.y + share * (to.y - from.y),
           from.z + share * (to.z - from.z)});
    }
  }
  if (!closed && !points.empty()) add(points.back());
  return line;
}

void Brush::line(const std::vector<cv::Point2d>& points, Rgb color, double width, bool closed) {
  if (points.size() < 2) return;
  const std::vector<std::vector<cv::Point>> lines{fine(points)};
  const int wide = std::max(1, cvRound(width * scale_));
  cv::polylines(picture_, lines, closed, kRim, wide + std::max(2, cvRound(2 * scale_)), cv::LINE_AA,
                kShift);
  cv::polylines(picture_, lines, closed, scalar_of(color), wide, cv::LINE_AA, kShift);
}

void Brush::hairline(const std::vector<cv::Point2d>& points, Rgb color) {
  if (points.size() < 2) return;
  cv::polylines(picture_, std::vector<std::vector<cv::Point>>{fine(points)}, true, scalar_of(color),
                1, cv::LINE_AA, kShift);
}

void Brush::fill(const std::vector<std::vector<cv::Point2d>>& shapes, Rgb color,
                 std::span<const double> shares) {
  cv::Mat share(picture_.size(), CV_8U, cv::Scalar(0));
  for (std::size_t i = 0; i < shapes.size(); ++i)
    cv::fillPoly(share, std::vector<std::vector<cv::Point>>{fine(shapes[i])},
                 cv::Scalar(255 * shares[i]), cv::LINE_8, kShift);
  const cv::Scalar own = scalar_of(color);
  for (int row = 0; row < picture_.rows; ++row) {
    auto* const pixels = picture_.ptr<cv::Vec3b>(row);
    const auto* const shown = share.ptr<std::uint8_t>(row);
    for (int column = 0; column < picture_.cols; ++column) {
      if (shown[column] == 0) continue;
      for (int channel = 0; channel < 3; ++channel) {
        const double below = pixels[column][channel];
        pixels[column][channel] =
            cv::saturate_cast<std::uint8_t>(below + shown[column] / 255.0 * (own[channel] - below));
      }
    }
  }
}

void Brush::cross(cv::Point2d at, Rgb color, double size, double width) {
  const double half = size * scale_;
  line({{at.x - half, at.y}, {at.x + half, at.y}}, color, width, false);
  line({{at.x, at.y - half}, {at.x, at.y + half}}, color, width, false);
}

void Brush::label(cv::Point2d at, const std::string& text, Rgb color) {
  const double font = kFontSize * scale_;
  const int wide = std::max(1, cvRound(1.4 * scale_));
  int below = 0;
  const cv::Size size = cv::getTextSize(text, kFont, font, wide, &below);
  const int rim = cvRound(4 * scale_);
  const int width = size.width + 2 * rim;
  const int height = size.height + below + rim;
  const int left = std::clamp(cvRound(at.x), 0, std::max(0, picture_.cols - width));
  const int top = std::clamp(cvRound(at.y) - height, 0, std::max(0, picture_.rows - height));
  cv::rectangle(picture_, cv::Rect(left, top, width, height), kRim, cv::FILLED);
  cv::putText(picture_, text, {left + rim, top + rim / 2 + size.height}, kFont, font,
              scalar_of(color), wide, cv::LINE_AA);
}

void Brush::panel(const std::vector<std::string>& lines, Rgb color, bool at_top) {
  if (lines.empty()) return;
  const double font = kFontSize * scale_;
  const int step = cvRound(30 * scale_);
  const int rim = cvRound(12 * scale_);
  std::vector<std::string> shown;
  int widest = 0;
  for (const std::string& each : lines) {
    shown.push_back(cut(each, font, picture_.cols - 4 * rim));
    widest = std::max(widest, cv::getTextSize(shown.back(), kFont, font, 1, nullptr).width);
  }
  const int height = step * static_cast<int>(lines.size()) + rim;
  const int top = at_top ? rim : picture_.rows - rim - height;
  cv::rectangle(picture_,
                cv::Rect(rim, top, widest + 2 * rim, height) & cv::Rect({}, picture_.size()), kRim,
                cv::FILLED);
  for (std::size_t i = 0; i < shown.size(); ++i)
    cv::putText(picture_, shown[i], {2 * rim, top + step * static_cast<int>(i + 1) - rim / 3},
                kFont, font, scalar_of(color), std::max(1, cvRound(1.4 * scale_)), cv::LINE_AA);
}

void Brush::note(cv::Point2d middle, const std::string& text, Rgb color) {
  const double font = kNoteSize * scale_;
  const cv::Size size = cv::getTextSize(text, kFont, font, 1, nullptr);
  cv::putText(picture_, text,
              {cvRound(middle.x - size.width / 2.0), cvRound(middle.y + size.height / 2.0)}, kFont,
              font, scalar_of(color), 1, cv::LINE_AA);
}

}  // namespace swarmsmith
