#include "tests/tracking/report/reported_run.h"

#include <cmath>
#include <string>

#include "tracking/geometry/view.h"

namespace swarmsmith {
namespace {

constexpr int kCycles = 600;
constexpr int kRobots = 3;

Pose circling(int robot, int cycle) {
  const double angle = 0.02 * cycle + 2.1 * robot;
  return {0.6 * std::cos(angle), 0.5 * std::sin(angle) + 0.1 * robot,
          std::remainder(angle + 1.5708, 6.2831853)};
}

Rig rig_of() {
  Rig rig;
  rig.file = "arena.toml";
  rig.cameras = {
      {.name = "ceiling", .model_file = "ceiling.camera.toml", .place_file = "ceiling.place.toml"}};
  rig.files["ceiling.camera.toml"] = {"ceiling.camera.toml", "", std::string(64, 'a'),
                                      "2026-11-20T09:00:00Z"};
  rig.files["rvr1.offset.toml"] = {"rvr1.offset.toml", "", std::string(64, 'c'),
                                   "2026-11-20T10:30:00Z"};
  rig.models["ceiling.camera.toml"] = {.rms_px = 0.0625,
                                       .worst_view_px = 0.125,
                                       .views = 17,
                                       .coverage = 0.875,
                                       .board = "chessboard:10x7:0.03",
                                       .made = "2026-11-20T09:00:00Z"};
  PlaceCalibration place{
      .place = {.rotation = {1, 0, 0, 0, -1, 0, 0, 0, -1}, .translation = {0, 0, 2.75}},
      .rms_px = 0.05,
      .worst_left_out_m = 0.0015,
      .worst_tag = 101,
      .coverage = 0.62,
      .made = "2026-11-20T09:30:00Z"};
  for (int tag = 100; tag < 104; ++tag) {
    const double u = 100.0 * (tag - 99);
    place.tags.push_back({.tag = {.tag = tag, .edge_m = 0.1},
                          .corners = {{{u, 300}, {u + 40, 300}, {u + 40, 260}, {u, 260}}},
                          .rms_px = 0.04,
                          .left_out_m = 0.001});
  }
  rig.places["ceiling.place.toml"] = place;
  for (int robot = 0; robot < kRobots; ++robot) {
    const std::string name = "rvr" + std::to_string(robot + 1);
    rig.robots.push_back({.name = name,
                          .tag = robot + 1,
                          .edge_m = 0.1,
                          .height_m = 0.2,
                          .offset_file = robot == 0 ? "rvr1.offset.toml" : ""});
  }
  rig.offsets["rvr1.offset.toml"] = {.robot = "rvr1",
                                     .tag = 1,
                                     .offset = {0.072, -0.004, 0.01},
                                     .has_yaw = true,
                                     .rms_m = 0.0004,
                                     .made = "2026-11-20T10:30:00Z"};
  return rig;
}

/// Four tags over five spans; one of them is covered in two, another was moved by two pixels.
CameraRecord record_of(const PlaceCalibration& place) {
  CameraRecord record{.camera = "ceiling",
                      .file = "run07.mp4",
                      .sha256 = std::string(64, 'b'),
                      .size = {1920, 1080},
                      .frames = 1812,
                      .damaged_frames = 1,
                      .time_source = TimeSource::Sidecar};
  for (int span = 0; span < 5; ++span) {
    for (const PlaceCalibration::Seen& seen : place.tags) {
      if (seen.tag.tag == 103 && span < 2) continue;
      ReferenceLook look{
          .time_s = 2.5 + 5.0 * span, .tag = seen.tag.tag, .corners = seen.corners, .frames = 150};
      for (ImagePoint& corner : look.corners)
        corner.u += seen.tag.tag == 102 ? 2 : 0.25;
      record.references.push_back(look);
    }
  }
  return record;
}

TrackedRobot robot_of(int number) {
  TrackedRobot robot{.name = "rvr" + std::to_string(number + 1), .tag = number + 1};
  robot.cycles.assign(kCycles, CycleKind::Measured);
  if (number == 1) {
    for (int cycle = 200; cycle < 204; ++cycle)
      robot.cycles[static_cast<std::size_t>(cycle)] = CycleKind::Interpolated;
    for (int cycle = 300; cycle < 308; ++cycle)
      robot.cycles[static_cast<std::size_t>(cycle)] = CycleKind::Degraded;
    robot.longest_gap_s = 0.83;
    robot.longest_gap_from_s = 30;
  }
  for (int cycle = 1; cycle <= kCycles; ++cycle) {
    robot.samples.push_back(
        {.time_s = 0.1 * cycle, .frame = 3 * cycle, .pose = circling(number, cycle)});
  }
  if (number == 2) {
    for (const std::size_t at : {99U, 100U, 450U})
      robot.samples[at].use = Sample::Use::Outlier;
    robot.outliers = 3;
  }
  robot.mean_scale = 1.0025;
  robot.mean_residual_m = 0.0003;
  robot.sigma.sigma_m = 0.0005;
  robot.sigma.sigma_rad = 0.002;
  robot.sigmas.assign(kCycles, robot.sigma);
  return robot;
}

}  // namespace

MadeUpRun::MadeUpRun() : rig(rig_of()) {
  log = {.name = "run07",
         .recorded = "2026-11-21",
         .mission = *built_in_mission("aggregation"),
         .design = "d3",
         .candidate = "c812"};
  log.videos = {{.camera = "ceiling", .file = "run07.mp4"}};
  observations.cameras.push_back(record_of(rig.places.begin()->second));
  tracked.trajectory.robots = kRobots;
  for (int cycle = 1; cycle <= kCycles; ++cycle)
    for (int robot = 0; robot < kRobots; ++robot)
      tracked.trajectory.poses.push_back(circling(robot, cycle));
  for (int robot = 0; robot < kRobots; ++robot) {
    tracked.starts.push_back(circling(robot, 0));
    tracked.robots.push_back(robot_of(robot));
  }
  tracked.covered_s = 60;
  tracked.frames = 1812;
  tracked.frames_dropped = 9;
  tracked.frames_twice = 2;
  tracked.frame_rate_least = 14.5;
  tracked.frame_rate_median = 30;
  tracked.frame_rate_most = 31;
  // The second robot's node was killed; the third has no log.
  for (const int robot : {1, 2}) {
    const std::string name = "rvr" + std::to_string(robot);
    RobotLog& own =
        observations.logs.emplace_back(RobotLog{name, "run07." + name + ".log.csv", {}});
    own.record.head.scheduling = "SCHED_FIFO 20";
    for (int cycle = 1; cycle <= 10; ++cycle) {
      if (robot == 2 && cycle == 4) continue;
      LogRow& row = own.record.rows.emplace_back();
      row.cycle = cycle;
      row.late_ms = 0.25 * cycle;
    }
  }
  observations.logs[0].record.head.clock_offset_s = -0.0035;
  observations.logs[0].record.head.end =
      RunEnd{.state = "ended", .verdict = RunVerdict::Valid, .stepped = 600};
  scored.latencies = {Latency{.seconds = 0.0625, .error_s = 0.0005, .agreement = 0.97},
                      Latency{.reason = "its commands did not move it"}, std::nullopt};
  scored.score = 2;
  scored.verdict = Verdict::Degraded;
  scored.reasons = {"rvr2 was bridged for 0.83 s from 30.0 s on <its tag was covered>"};
  scored.borders = {BorderDistance{0.21, "black spot at (0, 0)", false},
                    BorderDistance{-0.0007, "black spot at (0, 0)", true}, std::nullopt};
  scored.checks = {{.name = "frame rate",
                    .subject = "ceiling",
                    .outcome = Check::Outcome::Passed,
                    .value = 30,
                    .limit = 10,
                    .unit = "frames/s",
                    .catches = "gaps between frames"},
                   {.name = "cycles in long gaps",
                    .subject = "rvr2",
                    .outcome = Check::Outcome::Warned,
                    .value = 8,
                    .limit = 0,
                    .catches = "a path that is guessed"},
                   {.name = "motion as commanded",
                    .subject = "rvr3",
                    .outcome = Check::Outcome::NotRun,
                    .catches = "logs that were swapped",
                    .reason = "the run log names no log of it"}};
  scored.issues = {
      {IssueCode::TooCloseToCall, "rvr2 stands 0.7 mm from the black spot", "rvr2", 60.0, 60.0},
      {IssueCode::Interpolated, "rvr2 was bridged", "rvr2", 30.0, 30.83},
      {IssueCode::UnknownTags, "tags 17 and 35 & others", "", {}, {}}};
}

}  // namespace swarmsmith
