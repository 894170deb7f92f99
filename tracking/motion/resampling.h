#pragma once

#include <Eigen/Core>
#include <vector>

#include "tracking/motion/track_run.h"

namespace swarmsmith {

/// Converts samples at the times of frames to poses at the instants of the simulator.

/// The instant at the end of a control cycle, in seconds; cycle 0 is the start. The simulator has
/// the same instants (tracking facts, section 7).
inline double instant_s(int cycle) {
  return cycle * kControlPeriod_s;
}

/// Times that differ by less count as equal; subtracting a clock's offset causes rounding errors.
inline constexpr double kSameInstant_s = 1e-6;

/// A robot's centre at a time of the run.
struct TimedPose {
  double time_s = 0;
  Pose pose;
  Scatter sigma{};  ///< standard deviation of the pose
};

/// Whether a robot can get from `from` to `to` within the limits of speed and turn. A few
/// millimetres and a degree are added for the noise between frames in quick succession.
bool is_reachable(const TimedPose& from, const TimedPose& to, const TrackLimits& limits);

/// A pose at an instant, and how it was obtained.
struct PoseAt {
  Pose pose;
  Scatter sigma;  ///< if Missing, the distance that the robot may have gone within the limits
  CycleKind kind = CycleKind::Missing;
  double gap_s = 0;  ///< between its neighbours; 0 at a sample, or with only one neighbour
};

/// A robot's motion, estimated from its samples. Its velocities (along x, along y and turning) are
/// modelled as random walks driven by white noise. Then the mean of the motion, given all samples,
/// is a cubic smoothing spline, and its standard deviation is known at each time (Wahba 1978; the
/// recursion is from Rauch, Tung and Striebel 1965). The intensity of the noise is measured as the
/// mean over the run together with the changes of velocity around each gap, because robots go
/// straight for seconds and then turn suddenly.
class Motion {
 public:
  /// `track` is sorted by time and not empty.
  Motion(std::vector<TimedPose> track, const TrackLimits& limits);

  /// At the time of a sample, returns its pose unchanged. If interpolation is impossible, returns
  /// Missing with the last known pose (before the first sample, the pose of that sample). This is
  /// the case if there is only one neighbour, if the gap is longer than `degraded_gap_s`, or if the
  /// robot cannot get from one end of the gap to the other. Never extrapolates.
  PoseAt at(double time_s) const;

 private:
  /// First row: x, y and heading; second row: their velocities.
  using State = Eigen::Matrix<double, 2, 3>;
  /// Covariances of a coordinate and its velocity: one for both x and y, another for the heading.
  struct Covariance {
    Eigen::Matrix2d place;
    Eigen::Matrix2d heading;
  };
  /// Intensity of the white noise of the velocities: m^2/s^3 and rad^2/s^3.
  struct Diffusion {
    double place = 0;
    double heading = 0;
  };
  /// The estimate at a sample, given all samples.
  struct Knot {
    State state;
    Covariance covariance;
    Covariance with_next;    ///< between this knot and the next one
    bool is_joined = false;  ///< connected to the next knot
    Diffusion diffusion;     ///< until the next knot
  };

  void measure_diffusion();
  void smooth(std::size_t first, std::size_t last);
  PoseAt between(std::size_t before, double time_s) const;
  PoseAt held(const TimedPose& pose, double time_s, double gap_s) const;

  std::vector<TimedPose> track_;
  TrackLimits limits_;
  std::vector<Knot> knots_;  ///< one per sample
};

}  // namespace swarmsmith
