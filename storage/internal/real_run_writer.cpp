#include "storage/internal/real_run_writer.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "base/hash.h"
#include "storage/internal/real_run_parts.h"

namespace swarmsmith {
namespace {

using sqlite::Connection;
using sqlite::Statement;

/// Corners are stored in this fraction of a pixel, which is 80 times finer than the best detectors.
constexpr double kPartsOfPixel = 1000;

std::int64_t stored(double pixels) {
  return std::llround(pixels * kPartsOfPixel);
}

bool same_corners(const std::array<double, 8>& a, const std::array<double, 8>& b) {
  return std::ranges::equal(a, b, {}, stored, stored);
}

void require_finite(std::initializer_list<double> numbers, const std::string& what) {
  for (const double number : numbers)
    if (!std::isfinite(number)) throw std::invalid_argument("a number is not finite in " + what);
}

void require_finite(const std::array<double, 8>& corners, const std::string& what) {
  for (const double corner : corners)
    require_finite({corner}, what);
}

void require_numbers(const RealRunRows& rows) {
  require_finite({rows.duration_s, rows.score.score.value_or(0)}, "the run " + rows.name);
  for (const CalibrationRow& row : rows.calibrations)
    require_finite({row.rms}, "the calibration of " + row.subject);
  for (const RealVideoRow& row : rows.videos)
    for (const double time : row.frame_times)
      require_finite({time}, "the frame times of " + row.file);
  for (const RealRobotRow& row : rows.robots)
    require_finite({row.longest_gap_s, row.scale, row.residual_m, row.sigma_m, row.sigma_rad,
                    row.border_m.value_or(0)},
                   "the robot " + row.name);
  for (const RealSampleRow& row : rows.samples) {
    const std::string what = fmt::format("tag {} of frame {}", row.tag, row.frame);
    require_finite({row.time_s, row.margin, row.x, row.y, row.theta}, what);
    require_finite(row.corners, what);
  }
  for (const RealReferenceRow& row : rows.references) {
    const std::string what = fmt::format("the floor tag {}", row.tag);
    require_finite({row.time_s}, what);
    require_finite(row.corners, what);
  }
  for (const RealPatchRow& row : rows.patches)
    require_finite({row.x, row.y, row.width_m, row.height_m, row.radius_m}, "a patch");
  for (const RealCycleRow& row : rows.cycles)
    require_finite({row.x, row.y, row.theta}, fmt::format("cycle {}", row.cycle));
  for (const RealLogRow& row : rows.logs)
    require_finite({row.clock_offset_s.value_or(0), row.latency_s.value_or(0),
                    row.latency_error_s.value_or(0), row.agreement.value_or(0)},
                   "the log " + row.file);
  for (const RealLogCycleRow& row : rows.log_cycles) {
    const std::string what = fmt::format("cycle {} of a robot's log", row.cycle);
    require_finite({row.time_s, row.clock_s, row.late_ms, row.left_mps, row.right_mps}, what);
    for (const std::optional<double>& age_ms : row.ages_ms)
      require_finite({age_ms.value_or(0)}, what);
  }
  for (const RealCheckRow& row : rows.checks)
    require_finite({row.value.value_or(0), row.limit.value_or(0)}, "the check " + row.name);
  for (const RealIssueRow& row : rows.issues)
    require_finite({row.from_s.value_or(0), row.to_s.value_or(0)}, "the issue " + row.code);
}

void require_calibration(const RealRunRows& rows, const std::string& sha256, std::string_view kind,
                         const std::string& subject) {
  const bool is_there = std::ranges::any_of(rows.calibrations, [&](const CalibrationRow& row) {
    return row.sha256 == sha256 && row.kind == kind && row.subject == subject;
  });
  if (sha256.empty() || is_there) return;
  throw std::invalid_argument(
      fmt::format("the {} calibration of {} is not among the rows", kind, subject));
}

/// A text such as "[0,0.04,0.08]", with the shortest numbers that read back to the same bits.
std::string json_of(const std::vector<double>& numbers) {
  return fmt::format("[{}]", fmt::join(numbers, ","));
}

void write_calibrations(Connection& connection, const RealRunRows& rows) {
  Statement insert(connection, "INSERT OR IGNORE INTO calibration VALUES (?,?,?,?,?,?)");
  for (const CalibrationRow& row : rows.calibrations)
    insert.run(row.sha256, row.kind, row.subject, row.made, row.rms, row.file);
}

void write_robots(Connection& connection, RealRunId id, const RealRunRows& rows) {
  Statement insert(connection, "INSERT INTO real_robot VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)");
  for (const RealRobotRow& row : rows.robots) {
    insert.run(id.value, row.robot, row.name, row.tag, row.offset_calibration, row.measured,
               row.interpolated, row.degraded, row.missing, row.longest_gap_s, row.outliers,
               row.scale, row.residual_m, row.sigma_m, row.sigma_rad, row.border_m, row.too_close);
  }
}

void write_sightings(Connection& connection, RealRunId id, const RealRunRows& rows) {
  Statement video(connection, "INSERT INTO real_video VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?)");
  for (const RealVideoRow& row : rows.videos) {
    video.run(id.value, row.number, row.camera, row.file, row.sha256, row.time_source, row.width,
              row.height, row.frames, row.damaged_frames, row.camera_calibration,
              row.place_calibration, json_of(row.frame_times));
  }
  Statement sample(connection,
                   "INSERT INTO real_sample VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,"
                   "NULL,NULL,NULL,NULL,0)");
  std::int64_t number = 0;
  for (const RealSampleRow& row : rows.samples) {
    const auto& at = row.corners;
    sample.run(id.value, ++number, row.video, row.frame, row.time_s, row.tag, stored(at[0]),
               stored(at[1]), stored(at[2]), stored(at[3]), stored(at[4]), stored(at[5]),
               stored(at[6]), stored(at[7]), row.hamming, row.margin);
  }
  Statement reference(connection,
                      "INSERT INTO real_reference VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?)");
  number = 0;
  for (const RealReferenceRow& row : rows.references) {
    const auto& at = row.corners;
    reference.run(id.value, ++number, row.video, row.time_s, row.tag, stored(at[0]), stored(at[1]),
                  stored(at[2]), stored(at[3]), stored(at[4]), stored(at[5]), stored(at[6]),
                  stored(at[7]), row.frames);
  }
}

/// Writes the robot, pose and use of each sample, and its time, which depends on the camera's
/// readout and exposure in the arena file.
void write_poses(Connection& connection, RealRunId id, const RealRunRows& rows) {
  Statement robot(connection,
                  "UPDATE real_sample SET robot = ?3, x = ?4, y = ?5, theta = ?6, use = ?7,"
                  " time = ?8 WHERE run = ?1 AND number = ?2");
  std::int64_t number = 0;
  for (const RealSampleRow& row : rows.samples) {
    ++number;
    if (row.robot < 0) {
      robot.run(id.value, number, std::nullopt, std::nullopt, std::nullopt, std::nullopt, row.use,
                row.time_s);
    } else {
      robot.run(id.value, number, row.robot, row.x, row.y, row.theta, row.use, row.time_s);
    }
  }
}

void write_cycles(Connection& connection, RealRunId id, const RealRunRows& rows) {
  Statement patch(connection, "INSERT INTO real_patch VALUES (?,?,?,?,?,?,?,?)");
  std::int64_t number = 0;
  for (const RealPatchRow& row : rows.patches)
    patch.run(id.value, ++number, row.color, row.x, row.y, row.width_m, row.height_m, row.radius_m);
  Statement cycle(connection, "INSERT INTO real_cycle VALUES (?,?,?,?,?,?,?)");
  for (const RealCycleRow& row : rows.cycles)
    cycle.run(id.value, row.cycle, row.robot, row.x, row.y, row.theta, row.kind);
  Statement issue(connection, "INSERT INTO real_issue VALUES (?,?,?,?,?,?,?,?)");
  number = 0;
  for (const RealIssueRow& row : rows.issues) {
    issue.run(id.value, ++number, row.code, row.text, row.robot, row.from_s, row.to_s,
              row.of_observing);
  }
}

void write_checks(Connection& connection, RealRunId id, const RealRunRows& rows) {
  Statement check(connection, "INSERT INTO real_check VALUES (?,?,?,?,?,?,?,?,?,?)");
  std::int64_t number = 0;
  for (const RealCheckRow& row : rows.checks) {
    check.run(id.value, ++number, row.name, row.subject, row.outcome, row.value, row.limit,
              row.unit, row.catches, row.reason);
  }
}

void write_logs(Connection& connection, RealRunId id, const RealRunRows& rows) {
  Statement log(connection, "INSERT INTO real_log VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)");
  for (const RealLogRow& row : rows.logs) {
    log.run(id.value, row.robot, row.file, row.machine_digest, row.host, row.program,
            row.scheduling, row.clock_offset_s, row.state, row.verdict, row.reasons, row.stepped,
            row.held, row.skipped, row.latency_s, row.latency_error_s, row.agreement,
            row.latency_reason, row.head);
  }
  Statement cycle(connection,
                  "INSERT INTO real_log_cycle VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)");
  for (const RealLogCycleRow& row : rows.log_cycles) {
    cycle.run(id.value, row.cycle, row.robot, row.time_s, row.clock_s, row.late_ms, row.act,
              row.state, row.left_mps, row.right_mps, row.ages_ms[0], row.ages_ms[1],
              row.ages_ms[2], row.ages_ms[3], row.drawn, row.event);
  }
}

void write_score(Connection& connection, RealRunId id, const RealScoreRow& row) {
  Statement(connection,
            "INSERT INTO real_score (run, number, score, verdict, biased, program, reasons, report)"
            " SELECT ?1, coalesce(max(number), 0) + 1, ?2, ?3, ?4, ?5, ?6, ?7 FROM real_score"
            " WHERE run = ?1")
      .run(id.value, row.score, row.verdict, row.biased, row.program, row.reasons, row.report);
}

std::optional<std::int64_t> candidate_of(const RealRunRows& rows) {
  return rows.candidate ? std::optional(rows.candidate.value) : std::nullopt;
}

void count_parts(Connection& connection, RealRunId id) {
  for (const RealRunPart& part : kRealRunParts) {
    Statement(connection, fmt::format("UPDATE real_run SET {} = (SELECT count(*) FROM {}"
                                      " WHERE run = ?1) WHERE id = ?1",
                                      part.column, part.table))
        .run(id.value);
  }
}

/// Writes everything that follows from sightings and inputs.
void write_derived(Connection& connection, RealRunId id, const RealRunRows& rows) {
  write_calibrations(connection, rows);
  write_robots(connection, id, rows);
  write_poses(connection, id, rows);
  write_cycles(connection, id, rows);
  write_logs(connection, id, rows);
  write_checks(connection, id, rows);
  write_score(connection, id, rows.score);
  count_parts(connection, id);
}

}  // namespace

void require_whole(const RealRunRows& rows) {
  require_numbers(rows);
  for (const RealVideoRow& video : rows.videos) {
    require_calibration(rows, video.camera_calibration, "camera", video.camera);
    require_calibration(rows, video.place_calibration, "place", video.camera);
  }
  for (const RealRobotRow& robot : rows.robots)
    require_calibration(rows, robot.offset_calibration, "offset", robot.name);
}

RealRunId write_real_run(Connection& connection, const RealRunRows& rows) {
  Statement(connection,
            "INSERT INTO real_run (candidate, key, source, mission, name, recorded, duration,"
            " mission_file, arena_file, log) VALUES (?,?,?,?,?,?,?,?,?,?)")
      .run(candidate_of(rows), rows.key, rows.source, rows.mission, rows.name, rows.recorded,
           rows.duration_s, rows.mission_file, rows.arena_file, rows.log);
  const RealRunId id{sqlite3_last_insert_rowid(connection.handle())};
  write_sightings(connection, id, rows);
  write_derived(connection, id, rows);
  return id;
}

void rewrite_real_run(Connection& connection, RealRunId id, const RealRunRows& rows) {
  Statement(connection,
            "UPDATE real_run SET candidate = ?2, source = ?3, mission = ?4, name = ?5,"
            " recorded = ?6, duration = ?7, mission_file = ?8, arena_file = ?9, log = ?10,"
            " key = ?11 WHERE id = ?1")
      .run(id.value, candidate_of(rows), rows.source, rows.mission, rows.name, rows.recorded,
           rows.duration_s, rows.mission_file, rows.arena_file, rows.log, rows.key);
  Statement video(connection,
                  "UPDATE real_video SET camera = ?3, camera_calibration = ?4,"
                  " place_calibration = ?5 WHERE run = ?1 AND number = ?2");
  for (const RealVideoRow& row : rows.videos)
    video.run(id.value, row.number, row.camera, row.camera_calibration, row.place_calibration);
  for (const char* table : {"real_robot", "real_patch", "real_cycle", "real_issue", "real_log",
                            "real_log_cycle", "real_check"})
    Statement(connection, fmt::format("DELETE FROM {} WHERE run = ?", table)).run(id.value);
  write_derived(connection, id, rows);
}

void write_campaign_of_real_runs(Connection& connection, const std::string& key) {
  Digest digest;
  digest.add(std::string("real runs"));
  digest.add(key);
  Statement(connection,
            "INSERT INTO campaign (id, name, digest, deciding, file, seed, state, designs_before,"
            " finished) VALUES (1, 'real runs', ?, '{}', '', 0, 'imported', 0,"
            " strftime('%Y-%m-%dT%H:%M:%fZ', 'now'))")
      .run(digest.hex());
}

void write_override(Connection& connection, const RealOverrideRow& row) {
  Statement(connection,
            "INSERT INTO real_override (run, number, scoring, verdict, who, reason)"
            " SELECT ?1, coalesce(max(number), 0) + 1,"
            " (SELECT max(number) FROM real_score WHERE run = ?1), ?2, ?3, ?4 FROM real_override"
            " WHERE run = ?1")
      .run(row.run.value, row.verdict, row.who, row.reason);
}

void carry_overrides(Connection& connection, RealRunId id) {
  Statement(connection,
            "UPDATE real_override SET scoring = scoring + 1 WHERE run = ?1 AND scoring + 1 ="
            " (SELECT max(number) FROM real_score WHERE run = ?1)")
      .run(id.value);
}

bool same_scoring(const RealRunRows& a, const RealRunRows& b) {
  return a.key == b.key && differing_inputs(a, b).empty() && a.score.score == b.score.score &&
         a.score.verdict == b.score.verdict && a.score.biased == b.score.biased &&
         a.score.reasons == b.score.reasons;
}

std::vector<std::string> differing_inputs(const RealRunRows& a, const RealRunRows& b) {
  std::vector<std::string> differ;
  if (a.candidate != b.candidate) differ.emplace_back("the candidate");
  if (a.mission != b.mission || a.mission_file != b.mission_file)
    differ.emplace_back("the mission");
  if (a.log != b.log || a.source != b.source || a.name != b.name || a.recorded != b.recorded)
    differ.emplace_back("the run log");
  if (a.arena_file != b.arena_file) differ.emplace_back("the arena file");
  const auto of_video = [](const RealVideoRow& row) {
    return std::pair(row.camera_calibration, row.place_calibration);
  };
  if (!std::ranges::equal(a.videos, b.videos, {}, of_video, of_video) ||
      !std::ranges::equal(a.robots, b.robots, {}, &RealRobotRow::offset_calibration,
                          &RealRobotRow::offset_calibration))
    differ.emplace_back("calibrations");
  if (!std::ranges::equal(a.logs, b.logs, {}, &RealLogRow::head, &RealLogRow::head) ||
      a.log_cycles != b.log_cycles)
    differ.emplace_back("the robots' logs");
  return differ;
}

bool same_sightings(const RealRunRows& a, const RealRunRows& b) {
  return std::ranges::equal(a.videos, b.videos, {}, &RealVideoRow::sha256, &RealVideoRow::sha256) &&
         std::ranges::equal(
             a.samples, b.samples, [](const RealSampleRow& one, const RealSampleRow& other) {
               return one.video == other.video && one.frame == other.frame &&
                      one.tag == other.tag && same_corners(one.corners, other.corners);
             });
}

}  // namespace swarmsmith
