#include "sim/files/toml_text.h"
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
  for (const RobotSetup& robot : rig.robots) {
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
  const OffsetCalibration& offset = found->second;
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

}  // namespace

std::vector<Error> misfits(const Rig& rig) {
  std::vector<Error> errors;
  for (const CameraSetup& camera : rig.cameras)
    check_place(rig, camera, errors);
  for (const RobotSetup& robot : rig.robots)
    check_offset(rig, robot, errors);
  return errors;
}

}  // namespace swarmsmith
