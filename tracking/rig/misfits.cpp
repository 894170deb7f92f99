#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "base/text/toml_text.h"
#include "tracking/rig/calibration_limits.h"
#include "tracking/rig/rig_file.h"

namespace swarmsmith {
namespace {

void check_place(const Rig& rig, const CameraSetup& camera, std::vector<Error>& errors) {
  const auto model = rig.files.find(camera.model_file);
  const auto place = rig.places.find(camera.place_file);
  if (place == rig.places.end()) return;
  if (model != rig.files.end() && place->second.camera_sha256 != model->second.sha256) {
    errors.push_back(error_of(IssueCode::CalibrationQuality,
                              "the place of camera \"" + camera.name +
                                  "\" was found with another calibration than " +
                                  camera.model_file +
                                  "; find it again: `swarmsmith track calibrate arena`, then the "
                                  "robots: `swarmsmith track calibrate robot`",
                              camera.place_file));
  }
  const double height_m = place->second.place.centre().z;
  if (!(height_m >= camera.least_height_m && height_m <= camera.most_height_m)) {
    errors.push_back(error_of(
        IssueCode::Extrinsics,
        "camera \"" + camera.name + "\" hangs at " + number_text(height_m) +
            " m in this file, and `height` of " + rig.file + " says [" +
            number_text(camera.least_height_m) + ", " + number_text(camera.most_height_m) +
            "]; measure its height, then correct `height`, or find its place again: `swarmsmith "
            "track calibrate arena`",
        camera.place_file));
  }
  for (const RobotSetup& robot : each_tag(rig.robots)) {
    if (robot.height_m < height_m) continue;
    errors.push_back(error_of(IssueCode::Config,
                              "`height` of robot \"" + robot.name + "\" must be below camera \"" +
                                  camera.name + "\", which hangs at " + number_text(height_m) +
                                  " m; this is " + number_text(robot.height_m),
                              rig.file));
  }
}

void check_offset(const Rig& rig, const RobotSetup& robot, std::vector<Error>& errors) {
  const auto found = rig.offsets.find(robot.offset_file);
  if (found == rig.offsets.end()) return;
  const OffsetCalibration* const own = of_tag(found->second, robot.tag);
  const OffsetCalibration& offset = own == nullptr ? found->second : *own;
  std::string differences;
  const auto compare = [&](const std::string& what, bool equal, const std::string& made_for,
                           const std::string& now) {
    if (equal) return;
    differences += (differences.empty() ? "" : ", ") + what + " " + made_for + " and not " + now;
  };
  compare("robot", offset.robot == robot.name, "\"" + offset.robot + "\"",
          "\"" + robot.name + "\"");
  compare("tag", offset.tag == robot.tag, std::to_string(offset.tag), std::to_string(robot.tag));
  compare("edge", offset.edge_m == robot.edge_m, number_text(offset.edge_m),
          number_text(robot.edge_m));
  compare("height", offset.height_m == robot.height_m, number_text(offset.height_m),
          number_text(robot.height_m));
  if (differences.empty()) return;
  errors.push_back(error_of(IssueCode::CalibrationQuality,
                            "the offset of robot \"" + robot.name + "\" was found for " +
                                differences +
                                "; find it again: `swarmsmith track calibrate "
                                "robot " +
                                robot.name + "`",
                            robot.offset_file));
}

/// The RMS distance, in pixels, between the corners from which a place was solved and their
/// positions in the view from this place.
double rms_of_seen(const View& view, const PlaceCalibration& place) {
  double squares = 0;
  for (const PlaceCalibration::Seen& seen : place.tags)
    squares += squares_off(view, seen.tag, seen.corners);
  return place.tags.empty() ? 0 : std::sqrt(squares / static_cast<double>(4 * place.tags.size()));
}

/// Whether the arena file's entry for a floor tag has changed since the place was solved.
bool was_moved(const ReferenceTag& then, const ReferenceTag& now) {
  constexpr double kSame_m = 1e-4;
  constexpr double kSame_rad = 1e-3;
  return hypot(now.pose.x - then.pose.x, now.pose.y - then.pose.y) > kSame_m ||
         std::fabs(wrap_angle(now.pose.theta - then.pose.theta)) > kSame_rad ||
         std::fabs(now.edge_m - then.edge_m) > kSame_m;
}

std::string moved_tags(const Rig& rig, const PlaceCalibration& place) {
  std::string list;
  for (const PlaceCalibration::Seen& seen : place.tags) {
    const auto now = std::ranges::find(rig.references, seen.tag.tag, &ReferenceTag::tag);
    if (now == rig.references.end() || !was_moved(seen.tag, *now)) continue;
    list += fmt::format(
        "{}{} by {}", list.empty() ? "" : ", ", seen.tag.tag,
        millimetres(hypot(now->pose.x - seen.tag.pose.x, now->pose.y - seen.tag.pose.y)));
  }
  return list;
}

}  // namespace

std::vector<Issue> doubts_of_place(const Rig& rig, const CameraSetup& camera) {
  const auto place = rig.places.find(camera.place_file);
  const std::optional<View> view = rig.view_of(camera);
  if (place == rig.places.end() || !view) return {};
  std::vector<Issue> doubts;
  constexpr const char* kAgain =
      "`swarmsmith track calibrate arena --again` finds it from the same pictures";
  // Files keep corners to 1/1000 of a pixel.
  constexpr double kRounding_px = 0.01;
  const double rms_px = rms_of_seen(*view, place->second);
  if (!(rms_px <= place->second.rms_px + kRounding_px)) {
    doubts.push_back(
        {IssueCode::Extrinsics,
         fmt::format("the place of camera {} is not the one that {} was made with: "
                     "its floor tags are {:.2f} px RMS off, and {:.2f} px were found; "
                     "was the file edited? {}",
                     camera.name, camera.place_file, rms_px, place->second.rms_px, kAgain)});
  }
  if (const std::string list = moved_tags(rig, place->second); !list.empty()) {
    doubts.push_back({IssueCode::SurveyChanged,
                      fmt::format("{} has floor tags elsewhere than when the place of camera {} "
                                  "was found: {}; {}",
                                  rig.file, camera.name, list, kAgain)});
  }
  return doubts;
}

std::vector<Error> misfits_of_place(const Rig& rig, const CameraSetup& camera) {
  std::vector<Error> errors;
  check_place(rig, camera, errors);
  return errors;
}

std::vector<Error> misfits(const Rig& rig) {
  std::vector<Error> errors;
  for (const CameraSetup& camera : rig.cameras)
    check_place(rig, camera, errors);
  for (const RobotSetup& robot : each_tag(rig.robots))
    check_offset(rig, robot, errors);
  return errors;
}

}  // namespace swarmsmith
