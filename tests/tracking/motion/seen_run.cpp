#include "tests/tracking/motion/seen_run.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "base/math.h"
#include "base/rng.h"
#include "tracking/motion/resampling.h"

namespace swarmsmith {
namespace {

/// Above `place`, looking down, tilted by 3 degrees about the world's x axis.
View view_from_above(const Point& place) {
  const double c = std::cos(0.05);
  const double s = std::sin(0.05);
  View view{
      {{1920, 1080}, Lens::Pinhole, 1015, 1015, 959.5, 539.5, {-0.285, 0.08, 0.0005, -0.0003, 0}},
      {{1, 0, 0, 0, -c, s, 0, -s, -c}, {0, 0, 0}}};
  const Point3 down = view.place.seen_from_camera({place.x, place.y, 2.7});
  view.place.translation = {-down.x, -down.y, -down.z};
  return view;
}

Sighting sighting_of(const View& view, const Pose& robot, const Seeing& seeing, Rng& rng) {
  Sighting seen;
  const Pose tag = tag_pose_of_robot(robot, seeing.offset);
  seen.corners = seen_corners(view, tag, seeing.edge_m, seeing.height_m);
  for (ImagePoint& corner : seen.corners) {
    corner.u += seeing.noise_px * rng.normal();
    corner.v += seeing.noise_px * rng.normal();
  }
  seen.margin = 60;
  return seen;
}

/// Floor tags near the walls, as the camera sees them each second.
void lay_references(SeenRun& run, const Seeing& seeing, const View& view, PlaceCalibration& place,
                    CameraRecord& record) {
  run.rig.references.clear();
  for (int i = 0; i < 6; ++i) {
    const SinCos at = sin_cos(kPi / 3 * i + 0.4);
    const ReferenceTag tag{100 + i, {at.cos, at.sin, 0.3 * i}, 0.1};
    run.rig.references.push_back(tag);
    const TagCorners corners = seen_corners(view, tag.pose, tag.edge_m, 0);
    place.tags.push_back({tag, corners, 0, 0});
    for (double time = seeing.from_s + 0.5; time < instant_s(seeing.cycles) + seeing.past_end_s;
         time += 1)
      record.references.push_back({time + seeing.clock_s, tag.tag, corners, 30});
  }
}

void film(SeenRun& run, const Truth& truth, const Seeing& seeing, const View& view) {
  const int camera = static_cast<int>(run.observations.cameras.size());
  const std::string name = "camera" + std::to_string(camera);
  const std::string model = name + ".camera.toml";
  const std::string place = name + ".place.toml";
  run.rig.cameras.push_back({.name = name, .model_file = model, .place_file = place});
  run.rig.models[model].model = view.camera;
  run.rig.places[place].place = view.place;
  run.rig.places[place].coverage = 0.7;
  CameraRecord record{.camera = name, .file = name + ".mp4", .sha256 = name};
  record.size = view.camera.size;
  record.time_source = TimeSource::Sidecar;
  lay_references(run, seeing, view, run.rig.places[place], record);
  const Rng rng = Rng(seeing.seed).split("corners");
  const double end = instant_s(seeing.cycles) + seeing.past_end_s;
  for (std::int64_t frame = 0;; ++frame) {
    const double time = seeing.from_s + static_cast<double>(frame) / seeing.frame_rate;
    if (time > end + 1e-9) break;
    record.frame_times.push_back(time + seeing.clock_s);
    for (int robot = 0; robot < seeing.robots; ++robot) {
      Rng of_tag = rng.split(name + "/" + std::to_string(frame) + "/" + std::to_string(robot));
      Sighting seen = sighting_of(view, truth(robot, time), seeing, of_tag);
      seen.camera = camera;
      seen.frame = frame;
      seen.time_s = time + seeing.clock_s;
      seen.tag = robot + 1;
      run.observations.sightings.push_back(seen);
    }
  }
  record.frames = static_cast<std::int64_t>(record.frame_times.size());
  run.observations.cameras.push_back(record);
  run.options.span.starts_s.push_back(seeing.clock_s);
}

}  // namespace

void SeenRun::hide(int tag, double from_s, double to_s, int camera) {
  const double start = options.span.starts_s.at(static_cast<std::size_t>(camera));
  std::erase_if(observations.sightings, [&](const Sighting& seen) {
    return seen.tag == tag && seen.camera == camera && seen.time_s - start > from_s &&
           seen.time_s - start < to_s;
  });
}

void SeenRun::cut(double from_s, double to_s, int camera) {
  const double start = options.span.starts_s.at(static_cast<std::size_t>(camera));
  const auto is_cut = [&](double clock) { return clock - start > from_s && clock - start < to_s; };
  std::erase_if(observations.sightings,
                [&](const Sighting& seen) { return seen.camera == camera && is_cut(seen.time_s); });
  // Those that are left have other numbers.
  std::vector<double>& times =
      observations.cameras.at(static_cast<std::size_t>(camera)).frame_times;
  std::vector<std::int64_t> numbers;
  for (std::int64_t number = 0; const double time : times) {
    numbers.push_back(number);
    number += is_cut(time) ? 0 : 1;
  }
  for (Sighting& seen : observations.sightings) {
    if (seen.camera == camera) seen.frame = numbers.at(static_cast<std::size_t>(seen.frame));
  }
  std::erase_if(times, is_cut);
}

Expected<TrackedRun> SeenRun::track() const {
  return track_run(observations, rig, arena, options);
}

SeenRun seen_run(const Truth& truth, const Seeing& seeing) {
  SeenRun run;
  run.arena = dodecagon_of_the_thesis();
  run.options.span.cycles = seeing.cycles;
  run.rig.file = "arena.toml";
  for (int robot = 0; robot < seeing.robots; ++robot) {
    const std::string name = "rvr" + std::to_string(robot + 1);
    const std::string file = name + ".offset.toml";
    run.rig.robots.push_back({name, robot + 1, seeing.edge_m, seeing.height_m, file});
    OffsetCalibration& offset = run.rig.offsets[file];
    offset.robot = name;
    offset.tag = robot + 1;
    offset.offset = seeing.offset;
    offset.has_yaw = true;
  }
  film(run, truth, seeing, view_from_above({0, 0}));
  return run;
}

void add_camera(SeenRun& run, const Truth& truth, const Seeing& seeing, const Point& place) {
  film(run, truth, seeing, view_from_above(place));
}

Pose on_circle(int robot, double time_s) {
  const double angle = 0.6 * time_s + 2.0 * robot;
  const SinCos at = sin_cos(angle);
  return {0.5 * at.cos, 0.5 * at.sin, wrap_angle(angle + 0.5 * kPi)};
}

const Issue* find_issue(const TrackedRun& run, IssueCode code) {
  const auto found = std::ranges::find(run.issues, code, &Issue::code);
  return found == run.issues.end() ? nullptr : &*found;
}

namespace {

std::vector<double> errors_of(const TrackedRun& run, const Truth& truth) {
  std::vector<double> errors;
  for (int i = 0; i < run.trajectory.instants(); ++i) {
    for (int robot = 0; robot < run.trajectory.robots; ++robot) {
      const Pose& found = run.trajectory.at(i)[static_cast<std::size_t>(robot)];
      const Pose is = truth(robot, instant_s(i + 1));
      errors.push_back(std::hypot(found.x - is.x, found.y - is.y));
    }
  }
  return errors;
}

}  // namespace

double worst_error(const TrackedRun& run, const Truth& truth) {
  return std::ranges::max(errors_of(run, truth));
}

double rms_error(const TrackedRun& run, const Truth& truth) {
  double squares = 0;
  for (const double error : errors_of(run, truth))
    squares += error * error;
  return std::sqrt(squares / static_cast<double>(run.trajectory.poses.size()));
}

const Issue& issue_of(const TrackedRun& run, IssueCode code) {
  if (const Issue* issue = find_issue(run, code)) return *issue;
  std::string texts = "no issue of this kind among:";
  for (const Issue& issue : run.issues)
    texts += "\n" + issue.text;
  throw std::runtime_error(texts);
}

const Check* find_check(const TrackedRun& run, std::string_view name, std::string_view subject) {
  const auto found = std::ranges::find_if(run.checks, [&](const Check& check) {
    return check.name == name && check.subject == subject;
  });
  return found == run.checks.end() ? nullptr : &*found;
}

}  // namespace swarmsmith
