#include "tracking/scoring/real_run_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/overloaded.h"
#include "base/text/sha256.h"
#include "robot/log/log_text.h"
#include "sim/files/color_text.h"
#include "sim/files/mission_file.h"
#include "tracking/motion/resampling.h"

namespace swarmsmith {
namespace {

std::array<double, 8> flat(const TagCorners& corners) {
  std::array<double, 8> numbers{};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    numbers.at(2 * i) = std::round(corners.at(i).u * 1000) / 1000;
    numbers.at(2 * i + 1) = std::round(corners.at(i).v * 1000) / 1000;
  }
  return numbers;
}

/// The key of a run; it does not depend on the rig or the program with which the run is scored.
std::string key_of(const RunFindings& run, const std::vector<double>& starts_s) {
  std::string text;
  for (std::size_t i = 0; i < run.observations.cameras.size(); ++i) {
    // Rounded to milliseconds: starts that differ by less are the same.
    text += fmt::format("{} {:.3f}\n", run.observations.cameras[i].sha256, starts_s[i]);
  }
  return sha256_of(text);
}

void add_calibration(const Rig& rig, const std::string& file, CalibrationKind kind,
                     const std::string& subject, double rms, RealRunRows& rows) {
  const auto found = rig.files.find(file);
  if (found == rig.files.end()) return;
  const CalibrationFile& calibration = found->second;
  const bool is_there = std::ranges::any_of(rows.calibrations, [&](const CalibrationRow& row) {
    return row.sha256 == calibration.sha256 && row.kind == name_of(kind) && row.subject == subject;
  });
  if (is_there) return;
  rows.calibrations.push_back({calibration.sha256, std::string(name_of(kind)), subject,
                               calibration.made, rms, calibration.text});
}

void add_calibrations(const Rig& rig, RealRunRows& rows) {
  for (const CameraSetup& camera : rig.cameras) {
    const auto model = rig.models.find(camera.model_file);
    if (model != rig.models.end()) {
      add_calibration(rig, camera.model_file, CalibrationKind::Camera, camera.name,
                      model->second.rms_px, rows);
    }
    const auto place = rig.places.find(camera.place_file);
    if (place != rig.places.end()) {
      add_calibration(rig, camera.place_file, CalibrationKind::Place, camera.name,
                      place->second.rms_px, rows);
    }
  }
  for (const RobotSetup& robot : rig.robots) {
    const auto offset = rig.offsets.find(robot.offset_file);
    if (offset != rig.offsets.end()) {
      add_calibration(rig, robot.offset_file, CalibrationKind::Offset, robot.name,
                      offset->second.rms_m, rows);
    }
  }
}

void add_videos(const RunFindings& run, RealRunRows& rows) {
  for (const CameraFinding& camera : run.cameras) {
    const CameraRecord& record = *camera.record;
    const auto number = static_cast<std::int64_t>(rows.videos.size());
    rows.videos.push_back({.number = number,
                           .camera = record.camera,
                           .file = record.file,
                           .sha256 = record.sha256,
                           .time_source = std::string(name_of(record.time_source)),
                           .width = record.size.width,
                           .height = record.size.height,
                           .frames = record.frames,
                           .damaged_frames = record.damaged_frames,
                           .camera_calibration = camera.calibration_sha256,
                           .place_calibration = camera.place_sha256,
                           .frame_times = record.frame_times});
    for (const ReferenceLook& look : record.references)
      rows.references.push_back({number, look.time_s, look.tag, flat(look.corners), look.frames});
  }
}

void add_robots(const RunFindings& run, RealRunRows& rows) {
  for (const RobotFinding& robot : run.robots) {
    const TrackedRobot& tracked = *robot.tracked;
    RealRobotRow row{.robot = static_cast<std::int64_t>(rows.robots.size()),
                     .name = tracked.name,
                     .tag = tracked.tag,
                     .measured = robot.cycles(CycleKind::Measured),
                     .interpolated = robot.cycles(CycleKind::Interpolated),
                     .degraded = robot.cycles(CycleKind::Degraded),
                     .missing = robot.cycles(CycleKind::Missing),
                     .longest_gap_s = tracked.longest_gap_s,
                     .outliers = tracked.outliers,
                     .scale = tracked.mean_scale,
                     .residual_m = tracked.mean_residual_m,
                     .sigma_m = tracked.sigma.sigma_m,
                     .sigma_rad = tracked.sigma.sigma_rad};
    const bool is_centre = std::ranges::any_of(run.tracked.issues, [&](const Issue& issue) {
      return issue.code == IssueCode::TagAsCentre && issue.robot == tracked.name;
    });
    if (!is_centre) row.offset_calibration = robot.offset_sha256;
    if (robot.border != nullptr) {
      row.border_m = robot.border->signed_m;
      row.too_close = robot.border->too_close;
    }
    rows.robots.push_back(std::move(row));
  }
}

void add_samples(const RunFindings& run, RealRunRows& rows) {
  for (const Sighting& seen : run.observations.sightings) {
    rows.samples.push_back({.video = seen.camera,
                            .frame = seen.frame,
                            .time_s = seen.time_s,
                            .tag = seen.tag,
                            .corners = flat(seen.corners),
                            .hamming = seen.hamming,
                            .margin = seen.margin});
  }
  for (std::size_t i = 0; i < run.tracked.robots.size(); ++i) {
    for (const Sample& sample : run.tracked.robots[i].samples) {
      const auto note = [&](std::size_t sighting) {
        RealSampleRow& row = rows.samples.at(sighting);
        row.robot = static_cast<std::int64_t>(i);
        row.x = sample.pose.x;
        row.y = sample.pose.y;
        row.theta = sample.pose.theta;
        row.use = static_cast<std::int64_t>(sample.use);
      };
      note(sample.sighting);
      std::ranges::for_each(sample.more_sightings, note);
    }
  }
}

void add_cycles(const TrackedRun& run, RealRunRows& rows) {
  for (int cycle = 0; cycle <= run.trajectory.instants(); ++cycle) {
    for (std::size_t i = 0; i < run.robots.size(); ++i) {
      const Pose& pose = cycle == 0 ? run.starts[i] : run.trajectory.at(cycle - 1)[i];
      const CycleKind kind =
          run.robots[i].cycles.at(static_cast<std::size_t>(std::max(cycle, 1) - 1));
      rows.cycles.push_back({cycle, static_cast<std::int64_t>(i), pose.x, pose.y, pose.theta,
                             static_cast<std::int64_t>(kind)});
    }
  }
}

RealPatchRow patch_row(const Patch& patch) {
  RealPatchRow row{.color = color_text(patch.color)};
  std::visit(Overloaded{[&](const Disc& disc) {
                          row.x = disc.centre.x;
                          row.y = disc.centre.y;
                          row.radius_m = disc.radius_m;
                        },
                        [&](const Rectangle& box) {
                          row.x = box.centre.x;
                          row.y = box.centre.y;
                          row.width_m = box.width_m;
                          row.height_m = box.height_m;
                        },
                        // Patches of a run are on places, which are rectangles.
                        [](const FloorImage&) {}},
             patch.shape);
  return row;
}

std::string json_of(const std::vector<std::string>& sentences) {
  return nlohmann::json(sentences).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

RealLogRow log_row(const RobotFinding& robot, std::int64_t number) {
  const LogHead& head = robot.log->record.head;
  RealLogRow row{.robot = number,
                 .file = robot.log->file,
                 .machine_digest = head.machine_digest,
                 .host = head.host,
                 .program = head.program,
                 .scheduling = head.scheduling,
                 .clock_offset_s = head.clock_offset_s,
                 .stepped = robot.logged.stepped,
                 .held = robot.logged.held,
                 .skipped = robot.logged.skipped,
                 .head = log_head_text(head)};
  if (head.end) {
    row.state = head.end->state;
    row.verdict = name_of(head.end->verdict);
    row.reasons = json_of(head.end->reasons);
  }
  if (robot.latency != nullptr) {
    row.latency_s = robot.latency->seconds;
    if (row.latency_s) row.latency_error_s = robot.latency->error_s;
    row.agreement = robot.latency->agreement;
    row.latency_reason = robot.latency->reason;
  }
  return row;
}

void add_logs(const RunFindings& run, RealRunRows& rows) {
  for (std::size_t i = 0; i < run.robots.size(); ++i) {
    if (run.robots[i].log == nullptr) continue;
    const auto robot = static_cast<std::int64_t>(i);
    rows.logs.push_back(log_row(run.robots[i], robot));
    for (const LogRow& cycle : run.robots[i].log->record.rows) {
      rows.log_cycles.push_back({.cycle = cycle.cycle,
                                 .robot = robot,
                                 .time_s = cycle.sensed.time_s,
                                 .clock_s = cycle.clock_s,
                                 .late_ms = cycle.late_ms,
                                 .act = std::string(name_of(cycle.act)),
                                 .state = cycle.state,
                                 .left_mps = cycle.command.left_mps,
                                 .right_mps = cycle.command.right_mps,
                                 .ages_ms = cycle.age_ms,
                                 .drawn = static_cast<std::int64_t>(cycle.drawn),
                                 .event = cycle.event});
    }
  }
  std::ranges::stable_sort(rows.log_cycles, {}, &RealLogCycleRow::cycle);
}

void add_issues(const RunFindings& run, RealRunRows& rows) {
  const std::vector<Issue>& observed = run.observations.issues;
  for (const Issue& issue : run.scored.issues) {
    const bool of_observing = std::ranges::find(observed, issue) != observed.end();
    rows.issues.push_back({std::string(name_of(issue.code)), issue.text, issue.robot, issue.from,
                           issue.to, of_observing});
  }
}

}  // namespace

RealRunRows real_run_rows(const RunFindings& run, const std::string& arena_text,
                          const std::vector<double>& starts_s) {
  RealRunRows rows{.key = key_of(run, starts_s),
                   .name = run.log.name,
                   .recorded = run.log.recorded,
                   .source = run.log.source,
                   .mission = run.log.mission.name,
                   .arena_file = arena_text,
                   .log = run_log_text(run.log),
                   .mission_file = mission_text({.mission = run.log.mission}),
                   .duration_s = instant_s(run.log.mission.cycles)};
  add_calibrations(run.rig, rows);
  add_videos(run, rows);
  add_robots(run, rows);
  add_samples(run, rows);
  for (const Patch& patch : run.scored.patches)
    rows.patches.push_back(patch_row(patch));
  add_cycles(run.tracked, rows);
  add_logs(run, rows);
  add_issues(run, rows);
  for (const Check& check : run.scored.checks) {
    rows.checks.push_back({check.name, check.subject, std::string(name_of(check.outcome)),
                           check.value, check.limit, check.unit, check.catches, check.reason});
  }
  rows.score = {.score = run.scored.score,
                .verdict = std::string(name_of(run.scored.verdict)),
                .biased = run.scored.biased,
                .reasons = json_of(run.scored.reasons)};
  return rows;
}

}  // namespace swarmsmith
