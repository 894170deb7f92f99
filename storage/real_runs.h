#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/id.h"

namespace swarmsmith {

/// Runs of real robots as rows (docs/storage.md). They are not part of a campaign's answer.

/// A calibration file. Files with the same text share one row.
struct CalibrationRow {
  std::string sha256;   ///< of the file
  std::string kind;     ///< "camera", "place", "offset"
  std::string subject;  ///< name of the camera or robot
  std::string made;     ///< date and time, UTC; it is valid from then on
  double rms = 0;       ///< pixels; metres for an offset calibration
  std::string file;     ///< the whole text

  friend bool operator==(const CalibrationRow&, const CalibrationRow&) = default;
};

/// One camera's recording of a run.
struct RealVideoRow {
  std::int64_t number = 0;  ///< from 0
  std::string camera;
  std::string file;
  std::string sha256;
  std::string time_source;
  std::int64_t width = 0;
  std::int64_t height = 0;
  std::int64_t frames = 0;
  std::int64_t damaged_frames = 0;
  std::string camera_calibration;   ///< sha256
  std::string place_calibration;    ///< sha256
  std::vector<double> frame_times;  ///< one for each frame, by the camera's clock

  friend bool operator==(const RealVideoRow&, const RealVideoRow&) = default;
};

/// A robot of a run and how well it was tracked.
struct RealRobotRow {
  std::int64_t robot = 0;  ///< from 0, as in the score
  std::string name;
  std::int64_t tag = 0;
  std::string
      offset_calibration;  ///< sha256; empty when the tag was assumed to be at the robot's centre
  std::int64_t measured = 0;  ///< control cycles
  std::int64_t interpolated = 0;
  std::int64_t degraded = 0;
  std::int64_t missing = 0;
  double longest_gap_s = 0;
  std::int64_t outliers = 0;
  double scale = 1;
  double residual_m = 0;
  double sigma_m = 0;
  double sigma_rad = 0;
  std::optional<double> border_m;  ///< signed distance to the nearest border at the end
  bool too_close = false;

  friend bool operator==(const RealRobotRow&, const RealRobotRow&) = default;
};

/// A tag in a frame, as measured, and the robot that it was assigned to.
struct RealSampleRow {
  std::int64_t video = 0;
  std::int64_t frame = 0;
  double time_s = 0;  ///< the camera's clock
  std::int64_t tag = 0;
  std::array<double, 8> corners{};  ///< pixels: u, v of each corner; kept to 1/1000
  std::int64_t hamming = 0;
  double margin = 0;
  std::int64_t robot = -1;  ///< index of the robot; -1: none
  double x = 0;             ///< of the robot's centre; 0 when there is no robot
  double y = 0;
  double theta = 0;
  std::int64_t use = 0;  ///< Sample::Use

  friend bool operator==(const RealSampleRow&, const RealSampleRow&) = default;
};

/// Where a floor tag was during a few seconds of a video: medians over the frames.
struct RealReferenceRow {
  std::int64_t video = 0;
  double time_s = 0;  ///< the middle of these seconds, by the camera's clock
  std::int64_t tag = 0;
  std::array<double, 8> corners{};  ///< as in RealSampleRow
  std::int64_t frames = 0;

  friend bool operator==(const RealReferenceRow&, const RealReferenceRow&) = default;
};

/// A colour patch on the floor in this run, in addition to the patches of the mission's arena.
struct RealPatchRow {
  double x = 0;  ///< centre, metres
  double y = 0;
  double width_m = 0;  ///< for a rectangle; 0 for a disc
  double height_m = 0;
  double radius_m = 0;  ///< for a disc; 0 for a rectangle
  std::string color;    ///< "green", "#rrggbb"

  friend bool operator==(const RealPatchRow&, const RealPatchRow&) = default;
};

struct RealCycleRow {
  std::int64_t cycle = 0;  ///< 0 is the start
  std::int64_t robot = 0;
  double x = 0;
  double y = 0;
  double theta = 0;
  std::int64_t kind = 0;  ///< CycleKind; cycle 0 has the kind of cycle 1

  friend bool operator==(const RealCycleRow&, const RealCycleRow&) = default;
};

struct RealIssueRow {
  std::string code;
  std::string text;
  std::string robot;  ///< its name, or empty
  std::optional<double> from_s;
  std::optional<double> to_s;
  bool of_observing = false;  ///< about files, frames and times: a later scoring keeps it

  friend bool operator==(const RealIssueRow&, const RealIssueRow&) = default;
};

/// A check that a run has to pass before its score counts.
struct RealCheckRow {
  std::string name;
  std::string subject;  ///< the robot or camera; empty: the run
  std::string outcome;  ///< "passed", "warned", "failed", "not run"
  std::optional<double> value;
  std::optional<double> limit;
  std::string unit;  ///< of both
  std::string catches;
  std::string reason;  ///< why it was not run; empty in all other cases

  friend bool operator==(const RealCheckRow&, const RealCheckRow&) = default;
};

/// A robot's own log of a run, and the results of comparing it with the camera.
struct RealLogRow {
  std::int64_t robot = 0;  ///< as in RealRobotRow
  std::string file;
  std::string machine_digest;
  std::string host;
  std::string program;
  std::string scheduling;                ///< of the robot's control thread
  std::optional<double> clock_offset_s;  ///< the robot's clock minus the operator's
  std::string state;           ///< "ended", "stopped", "failed"; empty: the node was killed
  std::string verdict;         ///< the node's own; empty when it was killed
  std::string reasons = "[]";  ///< the node's reasons: JSON array of sentences
  std::int64_t stepped = 0;    ///< control cycles
  std::int64_t held = 0;
  std::int64_t skipped = 0;
  std::optional<double> latency_s;  ///< from a command to the robot's motion
  std::optional<double> latency_error_s;
  std::optional<double> agreement;  ///< between the robot's motion and its commands
  std::string latency_reason;       ///< why the latency could not be determined
  std::string head;                 ///< the complete TOML file of the log

  friend bool operator==(const RealLogRow&, const RealLogRow&) = default;
};

/// A control cycle of a robot's log.
struct RealLogCycleRow {
  std::int64_t cycle = 0;  ///< as counted in the log, from 1; skipped cycles have no row
  std::int64_t robot = 0;
  double time_s = 0;   ///< since the robot's start
  double clock_s = 0;  ///< the robot's monotonic clock
  double late_ms = 0;
  std::string act;  ///< "step" or "hold"
  std::int64_t state = 0;
  double left_mps = 0;  ///< commanded speed
  double right_mps = 0;
  std::array<std::optional<double>, 4> ages_ms{};  ///< proximity, ground, neighbours, light
  std::int64_t drawn = 0;                          ///< number of random numbers drawn so far
  std::string event;

  friend bool operator==(const RealLogCycleRow&, const RealLogCycleRow&) = default;
};

/// The score of a run and the inputs of this scoring. A later scoring replaces the results, but the
/// earlier score is kept.
struct RealScoreRow {
  std::optional<double> score;
  std::string verdict;  ///< "VALID", "DEGRADED", "INVALID"
  bool biased = false;
  std::string reasons;  ///< JSON array of sentences
  std::string report;   ///< JSON object: the quality report
  std::string program;  ///< "swarmsmith-track 0.1.0, OpenCV 4.6.0, ..."

  friend bool operator==(const RealScoreRow&, const RealScoreRow&) = default;
};

/// A user's verdict on a run, which overrides the computed one.
struct RealOverrideRow {
  RealRunId run;
  std::string verdict;
  std::string who;
  std::string reason;
};

/// A filmed trial with all its data; written as one unit.
struct RealRunRows {
  std::string
      key;  ///< sha256 over the videos and the start of the run: the same run has the same key
  std::string name;
  std::string recorded;  ///< date
  std::string source = "real";
  std::string mission;
  CandidateId candidate;   ///< the candidate that ran; none when not known
  std::string arena_file;  ///< the complete arena file, which describes the rig
  std::string log;         ///< the complete run log, with mission and patches
  /// The mission as a mission file (sim/files, mission_text). The score follows from it, `patches`
  /// and the cycles, so that `verify` can score the run again without the video.
  std::string mission_file;
  double duration_s = 0;
  std::vector<CalibrationRow> calibrations;
  std::vector<RealVideoRow> videos;
  std::vector<RealRobotRow> robots;
  std::vector<RealSampleRow> samples;        ///< by video, frame, tag
  std::vector<RealReferenceRow> references;  ///< by video, time, tag
  std::vector<RealPatchRow> patches;  ///< of the run log, or measured; empty if there were none
  std::vector<RealCycleRow> cycles;   ///< by cycle, robot
  std::vector<RealIssueRow> issues;
  std::vector<RealCheckRow> checks;         ///< empty if a program before schema 13 scored the run
  std::vector<RealLogRow> logs;             ///< by robot; only robots that have a log
  std::vector<RealLogCycleRow> log_cycles;  ///< by cycle, robot
  RealScoreRow score;

  friend bool operator==(const RealRunRows&, const RealRunRows&) = default;
};

/// The result of storing a run.
struct RealRunWritten {
  RealRunId id;
  bool is_new = true;  ///< false: the store already had it, from the same inputs
};

/// The data of a run without its samples and cycles.
struct RealRunHead {
  RealRunId id;
  std::string key;
  std::string name;
  std::string mission;
  CandidateId candidate;
  std::optional<double> score;  ///< of the latest scoring
  std::string verdict;  ///< the verdict that counts: the user's if there is one, else the latest
  bool counts = false;  ///< whether it counts among its candidate's scores
  std::int64_t scorings = 0;
};

}  // namespace swarmsmith
