#include "tracking/app/run_checks.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/plain_text.h"
#include "base/suggestion.h"
#include "sim/control/reference_model.h"
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

/// Adds an error for a robot of the log that the arena does not have, or that did not take part.
void check_robot(const std::string& robot, const std::string& section, const RunLog& log,
                 const Rig& rig, std::vector<Error>& errors) {
  const std::vector<std::string> robots = names_of(rig.robots);
  if (std::ranges::find(robots, robot) == robots.end()) {
    errors.push_back(unknown("robot", robot, robots, rig.file));
  } else if (!log.robots.empty() && std::ranges::find(log.robots, robot) == log.robots.end()) {
    errors.push_back(error_of(IssueCode::Config,
                              "the run's list `robots` leaves out \"" + robot + "\"; it has: " +
                                  joined(log.robots) + "; add it there, or take out its " + section,
                              log.name));
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
  const bool is_floor_tag = std::ranges::find(rig.references, log.start.sync_tag,
                                              &ReferenceTag::tag) != rig.references.end();
  if (log.start.sync != RunStart::Sync::None && is_floor_tag) {
    errors.push_back(error_of(IssueCode::Config,
                              "the run cannot begin with tag " +
                                  std::to_string(log.start.sync_tag) +
                                  " (`sync`), which is a floor tag of the arena; use a tag with "
                                  "another number, or give `start`",
                              rig.file));
  }
  for (const HandPoint& point : log.points) {
    check_robot(point.robot, "[[point]]", log, rig, errors);
    if (point.camera.empty() ? log.videos.size() > 1
                             : std::ranges::find(cameras, point.camera) == cameras.end()) {
      errors.push_back(unknown("camera", point.camera, cameras, rig.file));
    }
  }
  for (const RobotNote& note : log.notes)
    check_robot(note.robot, "[[robot]]", log, rig, errors);
  for (auto robot = log.robots.begin(); robot != log.robots.end(); ++robot) {
    check_robot(*robot, "name", log, rig, errors);
    if (std::find(log.robots.begin(), robot, *robot) == robot) continue;
    errors.push_back(error_of(IssueCode::Config,
                              "the run's list `robots` has \"" + *robot + "\" twice", log.name));
  }
  return errors;
}

std::vector<Error> faults_of_points(const RunLog& log) {
  std::vector<Error> errors;
  constexpr double kRounding_s = 1e-9;
  const double duration_s = log.mission.cycles * kControlPeriod_s;
  for (const HandPoint& point : log.points) {
    if (point.time_s >= 0 && point.time_s <= duration_s + kRounding_s) continue;
    errors.push_back(error_of(
        IssueCode::Config,
        fmt::format(
            "the [[point]] of \"{}\" is at {:.2f} s, but the run goes from 0 s to {:.1f} s; "
            "`time` counts from the start of the run, not of the film",
            point.robot, point.time_s, duration_s),
        log.name));
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
                 "mission " + mission.name + " has " + counted(mission.robots, "robot") +
                     ", but the run has " + std::to_string(rig.robots.size()) +
                     "; list in the run log those that took part: robots = [\"rvr1\", ...]",
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
