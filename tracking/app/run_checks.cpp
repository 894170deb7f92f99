#include "tracking/app/run_checks.h"

#include <algorithm>

#include "base/suggestion.h"
#include "tracking/rig/rig_file.h"

namespace swarmsmith {
namespace {

template <class Setup>
std::vector<std::string> names_of(const std::vector<Setup>& setups) {
  std::vector<std::string> names;
  names.reserve(setups.size());
  for (const Setup& setup : setups)
    names.push_back(setup.name);
  return names;
}

void check_camera(const Rig& rig, const CameraSetup& camera, std::vector<Error>& errors) {
  const auto lacks = [&](const std::string& file, const std::string& how) {
    errors.push_back(error_of(
        IssueCode::Config, "camera \"" + camera.name + "\" has no calibration " + file + "; " + how,
        rig.file));
  };
  if (!rig.models.contains(camera.model_file)) {
    lacks(camera.model_file, "`swarmsmith track calibrate camera` makes it");
  }
  if (!rig.places.contains(camera.place_file)) {
    lacks(camera.place_file, "`swarmsmith track calibrate arena` makes it");
  }
}

}  // namespace

Error unknown(const std::string& what, const std::string& name,
              const std::vector<std::string>& known, const std::string& file) {
  return error_of(IssueCode::Config,
                  "the arena has no " + what + " \"" + name + "\"" + did_you_mean(name, known) +
                      "; it has: " + joined(known),
                  file);
}

std::vector<Error> settle_names(RunLog& log, const Rig& rig) {
  std::vector<Error> errors;
  const std::vector<std::string> cameras = names_of(rig.cameras);
  // With one camera, or one video per camera in the order of the arena file, names are not needed.
  for (std::size_t i = 0; i < log.videos.size(); ++i) {
    std::string& camera = log.videos[i].camera;
    if (camera.empty() && log.videos.size() == cameras.size()) camera = cameras[i];
    if (camera.empty()) {
      errors.push_back(
          error_of(IssueCode::Config,
                   "which camera filmed " + log.videos[i].file +
                       "? Name it in a run log: [[video]] with camera and file; the arena has: " +
                       joined(cameras),
                   rig.file));
    } else if (std::ranges::find(cameras, camera) == cameras.end()) {
      errors.push_back(unknown("camera", camera, cameras, rig.file));
    }
  }
  for (const HandPoint& point : log.points) {
    const std::vector<std::string> robots = names_of(rig.robots);
    if (std::ranges::find(robots, point.robot) == robots.end())
      errors.push_back(unknown("robot", point.robot, robots, rig.file));
    if (point.camera.empty() ? log.videos.size() > 1
                             : std::ranges::find(cameras, point.camera) == cameras.end()) {
      errors.push_back(unknown("camera", point.camera, cameras, rig.file));
    }
  }
  for (const RobotNote& note : log.notes) {
    const std::vector<std::string> robots = log.robots.empty() ? names_of(rig.robots) : log.robots;
    if (std::ranges::find(robots, note.robot) == robots.end())
      errors.push_back(unknown("robot", note.robot, robots, rig.file));
  }
  for (const std::string& robot : log.robots) {
    const std::vector<std::string> robots = names_of(rig.robots);
    if (std::ranges::find(robots, robot) == robots.end()) {
      errors.push_back(unknown("robot", robot, robots, rig.file));
    }
  }
  return errors;
}

Rig rig_of_run(const Rig& rig, const RunLog& log) {
  Rig own = rig;
  own.cameras.clear();
  for (const RunVideo& video : log.videos) {
    const auto camera = std::ranges::find(rig.cameras, video.camera, &CameraSetup::name);
    if (camera != rig.cameras.end()) own.cameras.push_back(*camera);
  }
  if (log.robots.empty()) return own;
  std::erase_if(own.robots, [&](const RobotSetup& robot) {
    return std::ranges::find(log.robots, robot.name) == log.robots.end();
  });
  return own;
}

std::vector<Error> faults_of_rig(const Rig& rig, const Mission& mission,
                                 bool takes_tags_for_centres) {
  std::vector<Error> errors;
  for (const CameraSetup& camera : rig.cameras)
    check_camera(rig, camera, errors);
  for (Error& error : misfits(rig))
    errors.push_back(std::move(error));
  if (rig.robots.size() != static_cast<std::size_t>(mission.robots)) {
    errors.push_back(
        error_of(IssueCode::Config,
                 "mission " + mission.name + " has " + std::to_string(mission.robots) +
                     " robots, the run " + std::to_string(rig.robots.size()) +
                     "; name in the run log those that took part: robots = [\"rvr1\", ...]",
                 rig.file));
  }
  if (takes_tags_for_centres) return errors;
  for (const RobotSetup& robot : each_tag(rig.robots)) {
    if (rig.offset_of(robot)) continue;
    const std::string file = robot.offset_file.empty() ? "" : " " + robot.offset_file;
    errors.push_back(
        error_of(IssueCode::NoOffset,
                 "robot \"" + robot.name + "\" (tag " + std::to_string(robot.tag) +
                     ") has no offset calibration" + file +
                     "; `swarmsmith track calibrate robot` makes it "
                     "(--accept-tag-as-centre scores without, and marks the score BIASED)",
                 rig.file));
  }
  return errors;
}

std::vector<int> other_tags(const Rig& rig, const RunLog& log) {
  std::vector<int> tags;
  if (log.start.sync != RunStart::Sync::None) tags.push_back(log.start.sync_tag);
  if (log.robots.empty()) return tags;
  for (const RobotSetup& robot : each_tag(rig.robots)) {
    if (std::ranges::find(log.robots, robot.name) == log.robots.end()) tags.push_back(robot.tag);
  }
  return tags;
}

std::optional<std::vector<Patch>> said_patches(const RunLog& log) {
  if (log.layout.patches.empty()) return std::nullopt;
  std::vector<Patch> patches;
  for (const PatchPlacement& patch : log.layout.patches)
    patches.push_back({Rectangle{patch.centre, 0, 0}, patch.color});
  return patches;
}

}  // namespace swarmsmith
