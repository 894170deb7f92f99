#pragma once

#include <string>
#include <vector>

#include "tests/support/film/lab.h"
#include "tests/support/film/recorded_run.h"

namespace swarmsmith::film {

/// What a laboratory is made with; its truth.json keeps it, and runs are filmed in the same one.
struct LabWish {
  LabOptions lab;
  double rate_hz = 15;
  double exposure_s = 0.004;
  double readout_s = 0;
  double blur_px = 0.6;
  double noise = 2;
  double gain = 1;
  double gradient = 0.1;
  ClipForm form = ClipForm::H264;
  int views = 22;
};

/// An arm over a robot or the middle of the arena, for a while.
struct ArmWish {
  int robot = 0;  ///< 1, 2, ...; 0: the middle
  double from_s = 0;
  double until_s = 0;
};

/// What a run is filmed with; times are those of the run, 0 its start.
struct FilmWish {
  RunWish run;
  double rate_hz = 15;
  double before_s = 1.2;  ///< that the video begins before the run
  double after_s = 0.6;
  Schedule faults;  ///< drops, twice, jitter, counts_frames; the rest is filled in
  std::vector<ArmWish> arms;
  double bump_s = kForever_s;
  double swap_s = kForever_s;  ///< robots 1 and 2 carry each other's tag from then on
  bool duplicate = false;      ///< robot 1's tag lies on the floor once more
  bool sync = false;           ///< tag 99 beside the arena is hidden at the start
  bool sidecar = true;
  bool measured_layout = false;      ///< the log names no patches
  double cover_from_s = kForever_s;  ///< paper lies on robot 1's first tag
  double cover_until_s = kForever_s;
  double second_moved_m = 0;           ///< robot 1's second tag since it was calibrated
  std::vector<int> hidden_references;  ///< floor tags that something lies on
  bool robot_logs = false;             ///< each robot writes a log of what it commanded
  /// Another program's sidecar with `clock_s`, which says when frames are taken, and the run's
  /// start on that clock. Then neither sidecar nor run log is written.
  std::string camera_clock;
  double start_clock_s = 0;
  double second_ahead_s = 0.37;  ///< clock of the second camera minus the first's
};

/// As JSON, in truth.json under "wish", and back from that file's text.
std::string wish_json(const LabWish& wish);
LabWish wish_from_truth(const std::string& truth);

Shooting shooting_of(const LabWish& wish, const View& view);

/// DIR/arena.toml, DIR/truth.json, DIR/CAMERA.board/, and clips: CAMERA.arena, ROBOT.spin,
/// ROBOT.straight.
void film_lab(const LabWish& wish, const std::string& folder);

/// NAME.mkv (of more cameras: NAME.CAMERA.mkv), NAME.toml, NAME.trajectory.csv, NAME.truth.csv,
/// NAME.mission.toml and NAME.truth.json with the score and how near the end was to another one.
/// `name` is a path without an ending. Returns the line of truth.
std::string film_run(const LabWish& lab, const FilmWish& wish, const std::string& name,
                     const std::string& designs);

}  // namespace swarmsmith::film
