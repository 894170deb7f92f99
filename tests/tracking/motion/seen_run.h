#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "tests/support/overhead_camera.h"
#include "tracking/motion/track_run.h"

namespace swarmsmith {

/// Where a robot is at a time of the run.
using Truth = std::function<Pose(int robot, double time_s)>;

/// How a run is seen by a camera 2.7 m above the arena (tracking facts, the scene of [M]).
struct Seeing {
  int robots = 3;
  int cycles = 1200;
  double frame_rate = 30;
  double from_s = -0.5;     ///< first frame
  double past_end_s = 0.5;  ///< last frame
  double noise_px = 0;      ///< one sigma of each corner's coordinates
  std::uint64_t seed = 1;
  TagOffset offset{0.06, -0.04, 0.3};
  double height_m = 0.2;
  double edge_m = 0.1;
  double clock_s = 12.4;  ///< of the camera at the run's start
};

/// A run and all that it takes to track it. Robot i carries tag i + 1.
struct SeenRun {
  Rig rig;
  Arena arena;
  Observations observations;
  TrackOptions options;

  /// Sightings of a tag between two times of the run are not there.
  void hide(int tag, double from_s, double to_s, int camera = 0);
  /// No frame between two times of the run.
  void cut(double from_s, double to_s, int camera = 0);
  Expected<TrackedRun> track() const;
};

SeenRun seen_run(const Truth& truth, const Seeing& seeing = {});
/// Adds a camera at another place, with a clock of its own.
void add_camera(SeenRun& run, const Truth& truth, const Seeing& seeing, const Point& place);

/// Robots on circles of 0.5 m, 0.3 m/s, heading along them.
Pose on_circle(int robot, double time_s);

/// Distances of robots' cycles from where they were: the largest, and the root of the mean square.
double worst_error(const TrackedRun& run, const Truth& truth);
double rms_error(const TrackedRun& run, const Truth& truth = on_circle);

/// The first of a kind, or nothing.
const Issue* find_issue(const TrackedRun& run, IssueCode code);
/// The first of a kind, which has to be there.
const Issue& issue_of(const TrackedRun& run, IssueCode code);
const Check* find_check(const TrackedRun& run, std::string_view name, std::string_view subject);

}  // namespace swarmsmith
