#include "tracking/calibration/calibration_report.h"

#include <fmt/format.h>
#include <array>
#include <cmath>

#include "base/math.h"
#include "tracking/rig/calibration_limits.h"

namespace swarmsmith {
namespace {

constexpr double kDegree = kPi / 180;
constexpr std::array<std::string_view, 9> kNinths = {"upper left",  "upper middle", "upper right",
                                                     "middle left", "centre",       "middle right",
                                                     "lower left",  "lower middle", "lower right"};

std::string empty_ninths(const std::array<int, 9>& ninths) {
  std::string empty;
  for (std::size_t i = 0; i < ninths.size(); ++i) {
    if (ninths[i] == 0) empty += (empty.empty() ? "" : ", ") + std::string(kNinths[i]);
  }
  return empty;
}

}  // namespace

std::string report_text(const CameraSolution& solution, std::span<const BoardView> views) {
  const CameraCalibration& calibration = solution.calibration;
  const CameraModel& model = calibration.model;
  // OpenCV's fisheye solver does not give standard deviations.
  const double deviation = calibration.focal_sigma_px;
  const std::string sigma = deviation > 0 ? fmt::format(" (+- {:.2f})", deviation) : "";
  std::string text = fmt::format(
      "{} x {} pixels; fx {:.2f}, fy {:.2f}{}, centre ({:.2f}, {:.2f})\n", model.size.width,
      model.size.height, model.fx, model.fy, sigma, model.cx, model.cy);
  text += fmt::format(
      "RMS {:.3f} px ({}; limit {:.2f} px, {}) over {} views, worst {:.3f} px ({}); hull of the "
      "corners {:.0f} % of the frame\n\n",
      calibration.rms_px, on_the_floor(calibration.rms_px, model), rms_limit_px(model),
      on_the_floor(rms_limit_px(model), model), calibration.views, calibration.worst_view_px,
      on_the_floor(calibration.worst_view_px, model), calibration.coverage * 100);
  text += "Corners in each ninth of the frame:\n";
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column)
      text += fmt::format("{:7}", solution.ninths[3 * row + column]);
    text += "\n";
  }
  const std::string empty = empty_ninths(solution.ninths);
  if (!empty.empty()) text += "Empty: " + empty + ". Hold the board there, too.\n";
  text += "\n RMS px  corners  view\n";
  for (std::size_t i = 0; i < views.size(); ++i) {
    const SolvedView& view = solution.views[i];
    const bool few = view.residuals.empty();
    text += (few ? "      -" : fmt::format("{:7.3f}", view.rms_px)) +
            fmt::format("  {:7}  {}{}\n", views[i].seen.size(), views[i].name,
                        few            ? "  (too few corners)"
                        : view.dropped ? "  (dropped: over 3 times the median)"
                                       : "");
  }
  return text;
}

std::string report_text(const PlaceCalibration& calibration) {
  const Point3 centre = calibration.place.centre();
  const double limit_px = rms_limit_px(calibration);
  const double scale = pixels_per_metre(calibration);
  std::string text = fmt::format(
      "Camera at ({:.3f}, {:.3f}), {:.3f} m above the floor\nRMS {:.3f} px ({}; limit {:.2f} px, "
      "{}) over {} floor tags, which cover {:.0f} % of the arena that it sees; left out, a tag may "
      "be {} off\n\n    tag  RMS px  on the floor  off when left out\n",
      centre.x, centre.y, centre.z, calibration.rms_px,
      on_the_floor(calibration.rms_px, calibration), limit_px, on_the_floor(limit_px, calibration),
      calibration.tags.size(), calibration.coverage * 100, millimetres(PlaceLimits{}.left_out_m));
  for (const PlaceCalibration::Seen& seen : calibration.tags) {
    text += fmt::format("{:7}  {:6.3f}  {:>12}  {:>17}\n", seen.tag.tag, seen.rms_px,
                        millimetres(seen.rms_px / scale), millimetres(seen.left_out_m));
  }
  return text;
}

std::string report_text(const OffsetCalibration& calibration) {
  std::string text = fmt::format(
      "Tag {} sits at ({}, {}) of {}, in the tag's axes, +- ({}, {})\n", calibration.tag,
      millimetres(calibration.offset.x_m), millimetres(calibration.offset.y_m), calibration.robot,
      millimetres(calibration.sigma_x_m), millimetres(calibration.sigma_y_m));
  if (calibration.has_yaw) {
    text += fmt::format("Its heading is the robot's plus {:.2f} degrees\n",
                        calibration.offset.yaw_rad / kDegree);
  }
  return text + fmt::format("RMS {} over {} samples and {:.0f} degrees; the centre crept {}/s\n",
                            millimetres(calibration.rms_m), calibration.samples,
                            calibration.turned_rad / kDegree, millimetres(calibration.drift_m_s));
}

std::string residual_map_svg(const CameraSolution& solution, std::span<const BoardView> views) {
  const ImageSize size = solution.calibration.model.size;
  // Half a pixel is drawn as a twentieth of the width.
  const double scale = size.width / 10.0;
  const double stroke = size.width / 800.0;
  const double font = size.width / 50.0;
  const double foot = 3 * font;
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" "
      "font-family=\"sans-serif\" font-size=\"{:.1f}\">\n"
      "<rect width=\"{}\" height=\"{:.1f}\" fill=\"#ffffff\"/>\n"
      "<g stroke=\"#bbbbbb\" stroke-width=\"{:.2f}\" fill=\"none\">\n",
      size.width, size.height + foot, font, size.width, size.height + foot, stroke);
  for (int i = 0; i <= 3; ++i) {
    text += fmt::format("<path d=\"M{0:.1f} 0V{1}M0 {2:.1f}H{3}\"/>\n", size.width * i / 3.0,
                        size.height, size.height * i / 3.0, size.width);
  }
  text += fmt::format("</g>\n<g stroke=\"#0072b2\" stroke-width=\"{:.2f}\">\n", stroke);
  for (std::size_t i = 0; i < views.size(); ++i) {
    const SolvedView& view = solution.views[i];
    if (view.dropped) continue;
    for (std::size_t k = 0; k < view.residuals.size(); ++k) {
      const ImagePoint& at = views[i].seen[k];
      const ImagePoint& off = view.residuals[k];
      text += fmt::format("<path d=\"M{:.1f} {:.1f}l{:.2f} {:.2f}\"/>\n", at.u, at.v,
                          -off.u * scale, -off.v * scale);
    }
  }
  const double line = size.height + font * 1.8;
  text += fmt::format(
      "</g>\n<path d=\"M{0:.1f} {1:.1f}h{2:.1f}\" stroke=\"#000000\" stroke-width=\"{3:.2f}\"/>\n"
      "<text x=\"{4:.1f}\" y=\"{5:.1f}\">0.5 px</text>\n"
      "<text x=\"{6:.1f}\" y=\"{5:.1f}\" text-anchor=\"end\">from seen to expected corner; RMS "
      "{7:.3f} px, {8} views</text>\n</svg>\n",
      font, line - font * 0.35, scale / 2, 2 * stroke, font * 1.6 + scale / 2, line,
      size.width - font, solution.calibration.rms_px, solution.calibration.views);
  return text;
}

}  // namespace swarmsmith
