#include "storage/internal/real_run_reader.h"

#include <charconv>
#include <string>

#include <fmt/format.h>

#include "storage/internal/real_run_parts.h"

namespace swarmsmith {
namespace {

using sqlite::Connection;
using sqlite::Statement;

constexpr std::int64_t kFirstSchema = 5;

/// The numbers of a text such as "[0,0.04,0.08]".
std::vector<double> numbers_of(std::string_view json) {
  std::vector<double> numbers;
  const char* at = json.data();
  const char* const end = at + json.size();
  while (at != end) {
    double number = 0;
    const auto read = std::from_chars(at, end, number);
    if (read.ec == std::errc()) {
      numbers.push_back(number);
      at = read.ptr;
    } else {
      ++at;  // brackets and commas
    }
  }
  return numbers;
}

std::array<double, 8> corners_at(const Statement& row, int column) {
  std::array<double, 8> corners{};
  for (int i = 0; i < 8; ++i)
    corners[static_cast<std::size_t>(i)] = static_cast<double>(row.integer(column + i)) / 1000;
  return corners;
}

/// Runs `sql` for one run and calls `take` for each row.
template <class Take>
void each(const Connection& connection, RealRunId id, std::string_view sql, Take take) {
  Statement row(connection, sql);
  row.bind(id.value);
  while (row.step())
    take(row);
}

void read_calibrations(const Connection& connection, RealRunId id, RealRunRows& rows) {
  each(connection, id,
       "SELECT c.sha256, c.kind, c.subject, c.made, c.rms, c.file FROM calibration AS c JOIN ("
       "SELECT camera_calibration AS sha256, 'camera' AS kind, camera AS subject"
       " FROM real_video WHERE run = ?1 UNION "
       "SELECT place_calibration, 'place', camera FROM real_video WHERE run = ?1 UNION "
       "SELECT offset_calibration, 'offset', name FROM real_robot WHERE run = ?1)"
       " AS n USING (sha256, kind, subject) ORDER BY c.kind, c.subject, c.sha256",
       [&](const Statement& row) {
         rows.calibrations.push_back({.sha256 = row.text(0),
                                      .kind = row.text(1),
                                      .subject = row.text(2),
                                      .made = row.text(3),
                                      .rms = row.real(4),
                                      .file = row.text(5)});
       });
}

void read_videos(const Connection& connection, RealRunId id, RealRunRows& rows) {
  each(connection, id,
       "SELECT number, camera, file, sha256, time_source, width, height, frames, damaged_frames,"
       " camera_calibration, place_calibration, frame_times FROM real_video WHERE run = ?"
       " ORDER BY number",
       [&](const Statement& row) {
         rows.videos.push_back({.number = row.integer(0),
                                .camera = row.text(1),
                                .file = row.text(2),
                                .sha256 = row.text(3),
                                .time_source = row.text(4),
                                .width = row.integer(5),
                                .height = row.integer(6),
                                .frames = row.integer(7),
                                .damaged_frames = row.integer(8),
                                .camera_calibration = row.text(9),
                                .place_calibration = row.text(10),
                                .frame_times = numbers_of(row.text(11))});
       });
}

void read_robots(const Connection& connection, RealRunId id, RealRunRows& rows) {
  each(connection, id,
       "SELECT robot, name, tag, offset_calibration, measured, interpolated, degraded, missing,"
       " longest_gap, outliers, scale, residual, sigma, sigma_theta, border, too_close"
       " FROM real_robot WHERE run = ? ORDER BY robot",
       [&](const Statement& row) {
         rows.robots.push_back({.robot = row.integer(0),
                                .name = row.text(1),
                                .tag = row.integer(2),
                                .offset_calibration = row.text(3),
                                .measured = row.integer(4),
                                .interpolated = row.integer(5),
                                .degraded = row.integer(6),
                                .missing = row.integer(7),
                                .longest_gap_s = row.real(8),
                                .outliers = row.integer(9),
                                .scale = row.real(10),
                                .residual_m = row.real(11),
                                .sigma_m = row.real(12),
                                .sigma_rad = row.real(13),
                                .border_m = row.optional_real(14),
                                .too_close = row.integer(15) != 0});
       });
}

void read_sightings(const Connection& connection, RealRunId id, RealRunRows& rows) {
  each(connection, id,
       "SELECT video, frame, time, tag, u0, v0, u1, v1, u2, v2, u3, v3, hamming, margin, robot, x,"
       " y, theta, use FROM real_sample WHERE run = ? ORDER BY number",
       [&](const Statement& row) {
         rows.samples.push_back({.video = row.integer(0),
                                 .frame = row.integer(1),
                                 .time_s = row.real(2),
                                 .tag = row.integer(3),
                                 .corners = corners_at(row, 4),
                                 .hamming = row.integer(12),
                                 .margin = row.real(13),
                                 .robot = row.is_null(14) ? -1 : row.integer(14),
                                 .x = row.real(15),
                                 .y = row.real(16),
                                 .theta = row.real(17),
                                 .use = row.integer(18)});
       });
  each(connection, id,
       "SELECT video, time, tag, u0, v0, u1, v1, u2, v2, u3, v3, frames FROM real_reference"
       " WHERE run = ? ORDER BY number",
       [&](const Statement& row) {
         rows.references.push_back({.video = row.integer(0),
                                    .time_s = row.real(1),
                                    .tag = row.integer(2),
                                    .corners = corners_at(row, 3),
                                    .frames = row.integer(11)});
       });
}

void read_cycles(const Connection& connection, RealRunId id, RealRunRows& rows) {
  each(connection, id,
       "SELECT x, y, width, height, radius, color FROM real_patch WHERE run = ? ORDER BY number",
       [&](const Statement& row) {
         rows.patches.push_back({.x = row.real(0),
                                 .y = row.real(1),
                                 .width_m = row.real(2),
                                 .height_m = row.real(3),
                                 .radius_m = row.real(4),
                                 .color = row.text(5)});
       });
  each(connection, id,
       "SELECT cycle, robot, x, y, theta, kind FROM real_cycle WHERE run = ?"
       " ORDER BY cycle, robot",
       [&](const Statement& row) {
         rows.cycles.push_back({.cycle = row.integer(0),
                                .robot = row.integer(1),
                                .x = row.real(2),
                                .y = row.real(3),
                                .theta = row.real(4),
                                .kind = row.integer(5)});
       });
}

void read_logs(const Connection& connection, RealRunId id, RealRunRows& rows) {
  if (schema_of(connection) < kLogsSchema) return;
  each(
      connection, id,
      "SELECT robot, file, machine_digest, host, program, scheduling, clock_offset, state, verdict,"
      " reasons, stepped, held, skipped, latency, latency_error, agreement, latency_reason, head"
      " FROM real_log WHERE run = ? ORDER BY robot",
      [&](const Statement& row) {
        rows.logs.push_back({.robot = row.integer(0),
                             .file = row.text(1),
                             .machine_digest = row.text(2),
                             .host = row.text(3),
                             .program = row.text(4),
                             .scheduling = row.text(5),
                             .clock_offset_s = row.optional_real(6),
                             .state = row.text(7),
                             .verdict = row.text(8),
                             .reasons = row.text(9),
                             .stepped = row.integer(10),
                             .held = row.integer(11),
                             .skipped = row.integer(12),
                             .latency_s = row.optional_real(13),
                             .latency_error_s = row.optional_real(14),
                             .agreement = row.optional_real(15),
                             .latency_reason = row.text(16),
                             .head = row.text(17)});
      });
  each(connection, id,
       "SELECT cycle, robot, time, clock, late, act, state, left_speed, right_speed, age_proximity,"
       " age_ground, age_neighbours, age_light, drawn, event FROM real_log_cycle WHERE run = ?"
       " ORDER BY cycle, robot",
       [&](const Statement& row) {
         rows.log_cycles.push_back({.cycle = row.integer(0),
                                    .robot = row.integer(1),
                                    .time_s = row.real(2),
                                    .clock_s = row.real(3),
                                    .late_ms = row.real(4),
                                    .act = row.text(5),
                                    .state = row.integer(6),
                                    .left_mps = row.real(7),
                                    .right_mps = row.real(8),
                                    .ages_ms = {row.optional_real(9), row.optional_real(10),
                                                row.optional_real(11), row.optional_real(12)},
                                    .drawn = row.integer(13),
                                    .event = row.text(14)});
       });
}

void read_checks(const Connection& connection, RealRunId id, RealRunRows& rows) {
  if (schema_of(connection) < kChecksSchema) return;
  each(connection, id,
       "SELECT name, subject, outcome, value, bound, unit, catches, reason FROM real_check"
       " WHERE run = ? ORDER BY number",
       [&](const Statement& row) {
         rows.checks.push_back({.name = row.text(0),
                                .subject = row.text(1),
                                .outcome = row.text(2),
                                .value = row.optional_real(3),
                                .limit = row.optional_real(4),
                                .unit = row.text(5),
                                .catches = row.text(6),
                                .reason = row.text(7)});
       });
}

void read_outcome(const Connection& connection, RealRunId id, RealRunRows& rows) {
  each(connection, id,
       "SELECT code, text, robot, start, stop, of_observing FROM real_issue WHERE run = ?"
       " ORDER BY number",
       [&](const Statement& row) {
         rows.issues.push_back({.code = row.text(0),
                                .text = row.text(1),
                                .robot = row.text(2),
                                .from_s = row.optional_real(3),
                                .to_s = row.optional_real(4),
                                .of_observing = row.integer(5) != 0});
       });
  each(connection, id,
       "SELECT score, verdict, biased, reasons, report, program FROM real_score WHERE run = ?"
       " ORDER BY number DESC LIMIT 1",
       [&](const Statement& row) {
         rows.score = {.score = row.optional_real(0),
                       .verdict = row.text(1),
                       .biased = row.integer(2) != 0,
                       .reasons = row.text(3),
                       .report = row.text(4),
                       .program = row.text(5)};
       });
}

}  // namespace

std::vector<RealRunHead> read_real_runs(const Connection& connection, const Part& part) {
  std::vector<RealRunHead> runs;
  if (schema_of(connection) < kFirstSchema) return runs;
  std::string sql =
      "SELECT run, key, name, mission, candidate, score, verdict, counts, scoring"
      " FROM real_run_now";
  if (part.designs) {
    sql += fmt::format(" WHERE candidate BETWEEN {} AND {}",
                       part.designs_before * kCandidatesPerDesign + 1,
                       (part.designs_before + *part.designs) * kCandidatesPerDesign);
  }
  Statement row(connection, sql + " ORDER BY run");
  while (row.step()) {
    CandidateId candidate{row.integer(4)};
    if (candidate) candidate.value -= part.designs_before * kCandidatesPerDesign;
    runs.push_back({.id = {row.integer(0)},
                    .key = row.text(1),
                    .name = row.text(2),
                    .mission = row.text(3),
                    .candidate = candidate,
                    .score = row.optional_real(5),
                    .verdict = row.text(6),
                    .counts = row.integer(7) != 0,
                    .scorings = row.integer(8)});
  }
  return runs;
}

std::optional<RealRunRows> read_real_run(const Connection& connection, RealRunId id) {
  if (schema_of(connection) < kFirstSchema) return std::nullopt;
  std::optional<RealRunRows> rows;
  each(connection, id,
       "SELECT key, name, recorded, source, mission, candidate, arena_file, log, mission_file,"
       " duration FROM real_run WHERE id = ?",
       [&](const Statement& row) {
         rows = RealRunRows{.key = row.text(0),
                            .name = row.text(1),
                            .recorded = row.text(2),
                            .source = row.text(3),
                            .mission = row.text(4),
                            .candidate = {row.integer(5)},
                            .arena_file = row.text(6),
                            .log = row.text(7),
                            .mission_file = row.text(8),
                            .duration_s = row.real(9)};
       });
  if (!rows) return rows;
  read_calibrations(connection, id, *rows);
  read_videos(connection, id, *rows);
  read_robots(connection, id, *rows);
  read_sightings(connection, id, *rows);
  read_cycles(connection, id, *rows);
  read_logs(connection, id, *rows);
  read_checks(connection, id, *rows);
  read_outcome(connection, id, *rows);
  return rows;
}

std::optional<RealRunId> real_run_of_key(const Connection& connection, std::string_view key) {
  Statement row(connection, "SELECT id FROM real_run WHERE key = ?");
  row.bind(key);
  if (!row.step()) return std::nullopt;
  return RealRunId{row.integer(0)};
}

std::vector<std::string> faults_of_real_runs(const Connection& connection) {
  std::vector<std::string> faults;
  if (schema_of(connection) < kFirstSchema) return faults;
  const auto each_run = [&](const std::string& sql, std::string_view what) {
    Statement row(connection, sql);
    while (row.step())
      faults.push_back(
          fmt::format("the real run {} {}", to_string(RealRunId{row.integer(0)}), what));
  };
  each_run(
      "SELECT DISTINCT run FROM ("
      "SELECT run, camera_calibration AS sha256 FROM real_video UNION ALL "
      "SELECT run, place_calibration FROM real_video UNION ALL "
      "SELECT run, offset_calibration FROM real_robot)"
      " WHERE sha256 <> '' AND sha256 NOT IN (SELECT sha256 FROM calibration) ORDER BY run",
      "refers to calibrations that do not exist");
  each_run("SELECT id FROM real_run WHERE id NOT IN (SELECT run FROM real_score) ORDER BY id",
           "has no score");
  for (const RealRunPart& part : kRealRunParts) {
    if (schema_of(connection) < part.schema) continue;
    each_run(fmt::format("SELECT id FROM real_run AS r WHERE {} <>"
                         " (SELECT count(*) FROM {} AS p WHERE p.run = r.id) ORDER BY id",
                         part.column, part.table),
             fmt::format("lacks rows of its {}, or has too many", part.column));
  }
  return faults;
}

}  // namespace swarmsmith
