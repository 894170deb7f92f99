#include <utility>

#include "robot/log/log_text.h"
#include "tracking/robots/reality_text.h"
#include "tracking/scoring/real_run_rows.h"

namespace swarmsmith {
namespace {

TagCorners corners_of(const std::array<double, 8>& numbers) {
  TagCorners corners;
  for (std::size_t i = 0; i < corners.size(); ++i)
    corners.at(i) = {numbers.at(2 * i), numbers.at(2 * i + 1)};
  return corners;
}

TimeSource time_source_of(const std::string& name) {
  for (const TimeSource source : {TimeSource::Sidecar, TimeSource::Container}) {
    if (name == name_of(source)) return source;
  }
  return TimeSource::FrameRate;
}

/// The sha256 of the calibration of a camera or robot; empty if it took no part in the run.
std::string calibration_of(const RealRunRows& rows, CalibrationKind kind,
                           const std::string& subject) {
  for (const RealVideoRow& row : rows.videos) {
    if (kind == CalibrationKind::Offset || row.camera != subject) continue;
    return kind == CalibrationKind::Camera ? row.camera_calibration : row.place_calibration;
  }
  for (const RealRobotRow& row : rows.robots) {
    if (kind == CalibrationKind::Offset && row.name == subject) return row.offset_calibration;
  }
  return {};
}

Observations observations_of(const RealRunRows& rows) {
  Observations observations;
  for (const RealVideoRow& row : rows.videos) {
    CameraRecord record{.camera = row.camera, .file = row.file, .sha256 = row.sha256};
    record.size = {static_cast<int>(row.width), static_cast<int>(row.height)};
    record.frames = row.frames;
    record.damaged_frames = row.damaged_frames;
    record.time_source = time_source_of(row.time_source);
    record.frame_times = row.frame_times;
    for (const RealReferenceRow& look : rows.references) {
      if (look.video != row.number) continue;
      record.references.push_back({look.time_s, static_cast<int>(look.tag),
                                   corners_of(look.corners), static_cast<int>(look.frames)});
    }
    observations.cameras.push_back(std::move(record));
  }
  for (const RealSampleRow& row : rows.samples) {
    observations.sightings.push_back({static_cast<int>(row.video), row.frame, row.time_s,
                                      static_cast<int>(row.tag), corners_of(row.corners),
                                      static_cast<int>(row.hamming), row.margin});
  }
  for (const RealIssueRow& row : rows.issues) {
    const auto code = issue_code_from_name(row.code);
    if (!row.of_observing || !code) continue;
    observations.issues.push_back({*code, row.text, row.robot, row.from_s, row.to_s});
  }
  return observations;
}

/// The name of a robot, by its index.
std::string robot_of(const RealRunRows& rows, std::int64_t robot) {
  for (const RealRobotRow& row : rows.robots) {
    if (row.robot == robot) return row.name;
  }
  return {};
}

/// The robots' logs, as far as the store keeps them.
OrComplaints<std::vector<RobotLog>> logs_of(const RealRunRows& rows) {
  std::vector<RobotLog> logs;
  for (const RealLogRow& row : rows.logs) {
    auto head = parse_log_head(row.head, row.file);
    if (!head) return tl::unexpected(std::move(head.error()));
    RobotLog log{robot_of(rows, row.robot), row.file, {std::move(*head), {}}};
    log.neighbours = neighbours_in_report(rows.score.report, log.robot);
    for (const RealLogCycleRow& cycle : rows.log_cycles) {
      if (cycle.robot != row.robot) continue;
      LogRow& kept = log.record.rows.emplace_back();
      kept.cycle = cycle.cycle;
      kept.clock_s = cycle.clock_s;
      kept.late_ms = cycle.late_ms;
      kept.act = named<Act>(cycle.act).value_or(Act::Step);
      kept.state = static_cast<int>(cycle.state);
      kept.command.left_mps = cycle.left_mps;
      kept.command.right_mps = cycle.right_mps;
      kept.sensed.time_s = cycle.time_s;
      kept.age_ms = cycle.ages_ms;
      kept.drawn = static_cast<std::uint64_t>(cycle.drawn);
      kept.event = cycle.event;
    }
    logs.push_back(std::move(log));
  }
  return logs;
}

}  // namespace

OrComplaints<StoredRun> stored_run(const RealRunRows& rows) {
  const FindCalibration find =
      [&](CalibrationKind kind, const std::string& subject,
          const std::string& /*file*/) -> Expected<std::optional<std::string>> {
    const std::string used = calibration_of(rows, kind, subject);
    for (const CalibrationRow& row : rows.calibrations) {
      if (row.kind != name_of(kind)) continue;
      if (used.empty() ? row.subject == subject : row.sha256 == used) return row.file;
    }
    return std::nullopt;
  };
  OrComplaints<Rig> rig = parse_rig(rows.arena_file, "arena.toml", find);
  if (!rig) return tl::unexpected(std::move(rig.error()));
  OrComplaints<RunLog> log = parse_run_log(rows.log, rows.name + ".toml");
  if (!log) return tl::unexpected(std::move(log.error()));
  auto logs = logs_of(rows);
  if (!logs) return tl::unexpected(std::move(logs.error()));
  StoredRun run{std::move(*rig), std::move(*log), observations_of(rows)};
  run.observations.logs = std::move(*logs);
  return run;
}

}  // namespace swarmsmith
