#include <fmt/format.h>
#include <cmath>
#include <span>
#include <vector>

#include "base/math.h"
#include "base/text/toml_text.h"
#include "tracking/rig/calibration_limits.h"
#include "tracking/rig/rig_file.h"

namespace swarmsmith {
namespace {

std::string line(const char* key, const std::string& value, const std::string& comment = "") {
  return std::string(key) + " = " + value + (comment.empty() ? "" : "  # " + comment) + "\n";
}

std::string numbers(std::span<const double> values) {
  return "[" + list_of(values, number_text) + "]";
}

/// The first lines of every calibration file.
std::string head(const char* what, const char* kind, const std::string& made) {
  return std::string("# ") + what + "\nformat = 1\n" + line("kind", quoted_text(kind)) +
         line("made", quoted_text(made));
}

std::vector<double> pairs_of(const std::vector<ImagePoint>& points) {
  std::vector<double> pairs;
  for (const ImagePoint& point : points) {
    pairs.push_back(point.u);
    pairs.push_back(point.v);
  }
  return pairs;
}

/// The lines for one tag of a robot.
std::string tag_lines(const OffsetCalibration& calibration) {
  constexpr double kOneDegree = kPi / 180;
  return line("tag", std::to_string(calibration.tag)) +
         line("edge", number_text(calibration.edge_m)) +
         line("height", number_text(calibration.height_m), "of the tag above the floor") +
         line("x", number_text(calibration.offset.x_m), "from the robot's centre to the tag's") +
         line("y", number_text(calibration.offset.y_m)) +
         line("has_yaw", flag_text(calibration.has_yaw), "a straight run was filmed") +
         line("yaw_rad", number_text(calibration.offset.yaw_rad),
              fmt::format("the tag's heading minus the robot's: {:.2f} degrees",
                          calibration.offset.yaw_rad / kOneDegree)) +
         line("rms_m", number_text(calibration.rms_m), "at most 0.002") +
         line("sigma_x_m", number_text(calibration.sigma_x_m), "at most 0.0005") +
         line("sigma_y_m", number_text(calibration.sigma_y_m)) +
         line("drift_m_s", number_text(calibration.drift_m_s), "of the centre; at most 0.005") +
         line("turned_rad", number_text(calibration.turned_rad),
              fmt::format("{:.0f} degrees; at least 300", calibration.turned_rad / kOneDegree)) +
         line("samples", std::to_string(calibration.samples), "at least 60");
}

}  // namespace

std::string calibration_text(const CameraCalibration& calibration) {
  const CameraModel& model = calibration.model;
  const bool fisheye = model.lens == Lens::Fisheye;
  const auto count = static_cast<std::size_t>(fisheye ? 4 : 5);
  return head(
             "Intrinsics of a camera, made by `swarmsmith track calibrate camera`. They hold for "
             "this size\n# of picture, and as long as focus and zoom stay locked.",
             "camera", calibration.made) +
         line("board", quoted_text(calibration.board)) +
         line("views", std::to_string(calibration.views), "used; at least 10") +
         line("views_dropped", std::to_string(calibration.views_dropped), "as outliers") +
         line("rms_px", number_text(calibration.rms_px),
              "reprojection; limit " + number_text(std::round(100 * rms_limit_px(model)) / 100)) +
         line("worst_view_px", number_text(calibration.worst_view_px)) +
         line("coverage", number_text(calibration.coverage), "of the frame by the corners' hull") +
         line("hull", numbers(pairs_of(calibration.hull)), "u and v of its corners, in turn") +
         line("focal_sigma_px", number_text(calibration.focal_sigma_px),
              "standard deviation of f; 0: not known (fisheye)") +
         "\n[model]\n" + line("width", std::to_string(model.size.width), "pixels") +
         line("height", std::to_string(model.size.height)) +
         line("lens", quoted_text(fisheye ? "fisheye" : "pinhole")) +
         line("fx", number_text(model.fx), "focal lengths, pixels") +
         line("fy", number_text(model.fy)) +
         line("cx", number_text(model.cx), "principal point; whole numbers are middles of pixels") +
         line("cy", number_text(model.cy)) +
         line("distortion", numbers(std::span(model.distortion).first(count)),
              fisheye ? "k1, k2, k3, k4 (Kannala and Brandt)" : "k1, k2, p1, p2, k3 (Brown)");
}

std::string calibration_text(const PlaceCalibration& calibration) {
  const auto& r = calibration.place.rotation;
  const Point3& t = calibration.place.translation;
  const Point3 centre = calibration.place.centre();
  const std::array<double, 3> translation{t.x, t.y, t.z};
  std::string text =
      head(
          "Where a camera hangs, made by `swarmsmith track calibrate arena`: camera = rotation * "
          "world +\n# translation, metres. It holds until the camera or a floor tag is moved.",
          "place", calibration.made) +
      line("camera_sha256", quoted_text(calibration.camera_sha256), "of the intrinsics' file") +
      fmt::format("# The camera is at ({:.4f}, {:.4f}), {:.4f} m above the floor.\n", centre.x,
                  centre.y, centre.z) +
      line("rotation", numbers(r), "row by row") + line("translation", numbers(translation)) +
      line("rms_px", number_text(calibration.rms_px), "reprojection; good is 0.05") +
      line("worst_left_out_m", number_text(calibration.worst_left_out_m),
           "floor error of a tag, solved without it; at most 0.005") +
      line("worst_tag", std::to_string(calibration.worst_tag)) +
      line("coverage", number_text(calibration.coverage),
           "of the arena by the tags' hull; at least 0.5") +
      "\n# The floor tags that were used: as surveyed, and the medians of their corners in the "
      "picture\n# (u, v of bottom left, bottom right, top right, top left of the upright tag).\n";
  for (const PlaceCalibration::Seen& seen : calibration.tags) {
    std::vector<double> corners;
    for (const ImagePoint& corner : seen.corners)
      corners.insert(corners.end(), {corner.u, corner.v});
    text += "\n[[seen]]\n" + line("tag", std::to_string(seen.tag.tag)) +
            line("x", number_text(seen.tag.pose.x)) + line("y", number_text(seen.tag.pose.y)) +
            line("heading_rad", number_text(seen.tag.pose.theta)) +
            line("edge", number_text(seen.tag.edge_m)) + line("corners", numbers(corners)) +
            line("rms_px", number_text(seen.rms_px)) +
            line("left_out_m", number_text(seen.left_out_m));
  }
  return text;
}

std::string calibration_text(const OffsetCalibration& calibration) {
  std::string text = head(
                         "Where a robot's tag sits on it, made by `swarmsmith track calibrate "
                         "robot`. It holds until the\n# tag is moved. Lengths in metres, in the "
                         "tag's own axes.",
                         "offset", calibration.made) +
                     line("robot", quoted_text(calibration.robot)) + tag_lines(calibration);
  for (const OffsetCalibration& tag : calibration.more_tags)
    text += "\n[[more_tags]]\n" + tag_lines(tag);
  return text;
}

}  // namespace swarmsmith
