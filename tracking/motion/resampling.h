#pragma once

#include <Eigen/Core>
#include <vector>

#include "tracking/motion/track_run.h"

namespace swarmsmith {

/// From samples at the instants of frames to poses at the instants of the simulator.

/// The global instant that ends a control cycle; cycle 0 is the start. The simulator's own instants
/// (tracking facts, section 7).
inline double instant_s(int cycle) {
  return cycle * kControlPeriod_s;
}

/// Times nearer than this are one: the rounding of a clock's offset when it is subtracted.
inline constexpr double kSameInstant_s = 1e-6;

/// A robot's centre at a time of the run.
struct TimedPose {
  double time_s = 0;
  Pose pose;
  Scatter sigma{};  ///< of the pose
};

/// Whether a robot can have come from the one to the other, `from` first, at the limits' speed and
/// turn. A few millimetres and a degree are allowed for noise between frames that follow closely.
bool is_reachable(const TimedPose& from, const TimedPose& to, const TrackLimits& limits);

/// A pose at an instant and what it was made of.
struct PoseAt {
  Pose pose;
  Scatter sigma;  ///< where Missing, as far as the limits let the robot go
  CycleKind kind = CycleKind::Missing;
  double gap_s = 0;  ///< between the neighbours; 0 on a sample, and with one neighbour only
};

/// A robot's motion as its samples tell it. Its velocities, along x, along y and turning, are taken
/// for random walks that change by white noise: then the mean of the motion, given all samples, is
/// a cubic smoothing spline, and its standard deviation is known at each time (Wahba 1978; the
/// recursion is that of Rauch, Tung and Striebel 1965). How much velocities change is measured: the
/// mean over the run, and what they change by around the gap itself, since robots go straight for
/// seconds and turn at once.
class Motion {
 public:
  /// `track` is sorted by time and not empty.
  Motion(std::vector<TimedPose> track, const TrackLimits& limits);

  /// A sample at the instant itself gives its own bits. Missing, and the last known pose (before
  /// the first sample that one), where there is nothing to interpolate between: one neighbour only,
  /// more than `degraded_gap_s`, or ends that the robot cannot have reached. Never extrapolates.
  PoseAt at(double time_s) const;

 private:
  /// x, y and heading, with their velocities below them.
  using State = Eigen::Matrix<double, 2, 3>;
  /// Of a position and its velocity: x and y have one, the heading another.
  struct Covariance {
    Eigen::Matrix2d place;
    Eigen::Matrix2d heading;
  };
  /// White noise of the velocities: m^2/s^3 and rad^2/s^3.
  struct Diffusion {
    double place = 0;
    double heading = 0;
  };
  /// What is known at a sample, from all samples.
  struct Knot {
    State state;
    Covariance covariance;
    Covariance with_next;    ///< of this one and the next
    bool is_joined = false;  ///< with the next one
    Diffusion diffusion;     ///< until the next one
  };

  void measure_diffusion();
  void smooth(std::size_t first, std::size_t last);
  PoseAt between(std::size_t before, double time_s) const;
  PoseAt held(const TimedPose& pose, double time_s, double gap_s) const;

  std::vector<TimedPose> track_;
  TrackLimits limits_;
  std::vector<Knot> knots_;  ///< one a sample
};

}  // namespace swarmsmith
