#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/id.h"

namespace swarmsmith {

/// Runs of real robots as rows (docs/storage.md). They are not part of a campaign's answer.

/// A calibration file, once for each text.
struct CalibrationRow {
  std::string sha256;   ///< of the file
  std::string kind;     ///< "camera", "place", "offset"
  std::string subject;  ///< the camera's or the robot's name
  std::string made;     ///< date and time, UTC; it holds from then on
  double rms = 0;       ///< pixels, of an offset metres
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
  std::vector<double> frame_times;  ///< one a frame, the camera's clock

  friend bool operator==(const RealVideoRow&, const RealVideoRow&) = default;
};

/// A robot of a run and how well it was tracked.
struct RealRobotRow {
  std::int64_t robot = 0;  ///< from 0, as in the score
  std::string name;
  std::int64_t tag = 0;
  std::string offset_calibration;  ///< sha256; empty when its tag was taken for its centre
  std::int64_t measured = 0;       ///< control cycles
  std::int64_t interpolated = 0;
  std::int64_t degraded = 0;
  std::int64_t missing = 0;
  double longest_gap_s = 0;
  std::int64_t outliers = 0;
  double scale = 1;
  double residual_m = 0;
  double sigma_m = 0;
  double sigma_rad = 0;
  std::optional<double> border_m;  ///< signed, at the end
  bool too_close = false;

  friend bool operator==(const RealRobotRow&, const RealRobotRow&) = default;
};

/// A tag in a frame, as measured, and what it was taken for.
struct RealSampleRow {
  std::int64_t video = 0;
  std::int64_t frame = 0;
  double time_s = 0;  ///< the camera's clock
  std::int64_t tag = 0;
  std::array<double, 8> corners{};  ///< pixels: u, v of each corner; kept to 1/1000
  std::int64_t hamming = 0;
  double margin = 0;
  std::int64_t robot = -1;  ///< -1: none
  double x = 0;             ///< of the robot's centre; 0 when there is none
  double y = 0;
  double theta = 0;
  std::int64_t use = 0;  ///< Sample::Use

  friend bool operator==(const RealSampleRow&, const RealSampleRow&) = default;
};

/// Where a floor tag was within one span of some seconds of a video: medians over its frames.
struct RealReferenceRow {
  std::int64_t video = 0;
  double time_s = 0;  ///< the span's middle, the camera's clock
  std::int64_t tag = 0;
  std::array<double, 8> corners{};  ///< as of a sample
  std::int64_t frames = 0;

  friend bool operator==(const RealReferenceRow&, const RealReferenceRow&) = default;
};

/// A colour patch that lay on the floor of this run, over those of the mission's arena.
struct RealPatchRow {
  double x = 0;  ///< of its middle, metres
  double y = 0;
  double width_m = 0;  ///< of a rectangle; 0 of a disc
  double height_m = 0;
  double radius_m = 0;  ///< of a disc; 0 of a rectangle
  std::string color;    ///< "green", "#rrggbb"

  friend bool operator==(const RealPatchRow&, const RealPatchRow&) = default;
};

struct RealCycleRow {
  std::int64_t cycle = 0;  ///< 0 is the start
  std::int64_t robot = 0;
  double x = 0;
  double y = 0;
  double theta = 0;
  std::int64_t kind = 0;  ///< CycleKind; of cycle 0 that of cycle 1

  friend bool operator==(const RealCycleRow&, const RealCycleRow&) = default;
};

struct RealIssueRow {
  std::string code;
  std::string text;
  std::string robot;  ///< its name, or empty
  std::optional<double> from_s;
  std::optional<double> to_s;
  bool of_observing = false;  ///< of files, frames and times: a later scoring keeps it

  friend bool operator==(const RealIssueRow&, const RealIssueRow&) = default;
};

/// A question that the run was asked before its score counts.
struct RealCheckRow {
  std::string name;
  std::string subject;  ///< the robot or camera; empty: the run
  std::string outcome;  ///< "passed", "warned", "failed", "not run"
  std::optional<double> value;
  std::optional<double> limit;
  std::string unit;  ///< of both
  std::string catches;
  std::string reason;  ///< why it was not run; empty for all others

  friend bool operator==(const RealCheckRow&, const RealCheckRow&) = default;
};

/// A robot's own log of a run, and what follows from it beside the camera.
struct RealLogRow {
  std::int64_t robot = 0;  ///< as of RealRobotRow
  std::string file;
  std::string machine_digest;
  std::string host;
  std::string program;
  std::string scheduling;                ///< of its control thread
  std::optional<double> clock_offset_s;  ///< its clock minus the operator's
  std::string state;                     ///< "ended", "stopped", "failed"; empty: it was killed
  std::string verdict;                   ///< its node's; empty when it was killed
  std::string reasons = "[]";            ///< JSON array of sentences, the node's
  std::int64_t stepped = 0;              ///< control cycles
  std::int64_t held = 0;
  std::int64_t skipped = 0;
  std::optional<double> latency_s;  ///< of its motion behind its commands
  std::optional<double> latency_error_s;
  std::optional<double> agreement;  ///< of its motion with its commands
  std::string latency_reason;       ///< why the latency cannot be told
  std::string head;                 ///< the log's TOML file, whole

  friend bool operator==(const RealLogRow&, const RealLogRow&) = default;
};

/// A control cycle of a robot's log.
struct RealLogCycleRow {
  std::int64_t cycle = 0;  ///< as the log counts, from 1; skipped ones have no row
  std::int64_t robot = 0;
  double time_s = 0;   ///< since the robot's start
  double clock_s = 0;  ///< the robot's monotonic clock
  double late_ms = 0;
  std::string act;  ///< "step" or "hold"
  std::int64_t state = 0;
  double left_mps = 0;  ///< as commanded
  double right_mps = 0;
  std::array<std::optional<double>, 4> ages_ms{};  ///< proximity, ground, neighbours, light
  std::int64_t drawn = 0;                          ///< random numbers so far
  std::string event;

  friend bool operator==(const RealLogCycleRow&, const RealLogCycleRow&) = default;
};

/// What a run was scored with, and what came out; a later scoring replaces what follows from it and
/// keeps the earlier score.
struct RealScoreRow {
  std::optional<double> score;
  std::string verdict;  ///< "VALID", "DEGRADED", "INVALID"
  bool biased = false;
  std::string reasons;  ///< JSON array of sentences
  std::string report;   ///< JSON object: the quality report
  std::string program;  ///< "swarmsmith-track 0.1.0, OpenCV 4.6.0, ..."

  friend bool operator==(const RealScoreRow&, const RealScoreRow&) = default;
};

/// A person's word on a run, which counts above the verdict.
struct RealOverrideRow {
  RealRunId run;
  std::string verdict;
  std::string who;
  std::string reason;
};

/// A filmed trial with all that belongs to it; written as one.
struct RealRunRows {
  std::string key;  ///< sha256 over the videos' and the run's begin: the same run has the same key
  std::string name;
  std::string recorded;  ///< date
  std::string source = "real";
  std::string mission;
  CandidateId candidate;   ///< that ran; none when not known
  std::string arena_file;  ///< the rig, whole
  std::string log;         ///< the run log, whole, mission and patches included
  /// The mission as a file of its own (sim/files, mission_text); with `patches` and the cycles it
  /// is all that the score follows from, so that `verify` can score again without a camera.
  std::string mission_file;
  double duration_s = 0;
  std::vector<CalibrationRow> calibrations;
  std::vector<RealVideoRow> videos;
  std::vector<RealRobotRow> robots;
  std::vector<RealSampleRow> samples;        ///< by video, frame, tag
  std::vector<RealReferenceRow> references;  ///< by video, time, tag
  std::vector<RealPatchRow> patches;         ///< of the log, or measured; none where there are none
  std::vector<RealCycleRow> cycles;          ///< by cycle, robot
  std::vector<RealIssueRow> issues;
  std::vector<RealCheckRow> checks;         ///< none: a program before schema 13 scored it
  std::vector<RealLogRow> logs;             ///< by robot; those that have one
  std::vector<RealLogCycleRow> log_cycles;  ///< by cycle, robot
  RealScoreRow score;

  friend bool operator==(const RealRunRows&, const RealRunRows&) = default;
};

/// Where a run that was to be stored is.
struct RealRunWritten {
  RealRunId id;
  bool is_new = true;  ///< false: it was there already, from the same inputs
};

/// What is known of a run without its samples and cycles.
struct RealRunHead {
  RealRunId id;
  std::string key;
  std::string name;
  std::string mission;
  CandidateId candidate;
  std::optional<double> score;  ///< the latest
  std::string verdict;          ///< that counts: a person's, else the latest
  bool counts = false;          ///< among the scores of its candidate
  std::int64_t scorings = 0;
};

}  // namespace swarmsmith
