#include "tracking/motion/resampling.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "base/assert.h"
#include "base/math.h"

// Each coordinate of a robot is the integral of a velocity that is a random walk. Its best estimate
// from samples before and after is computed separately for each coordinate, with a Kalman filter
// forwards (Kalman 1960) and the smoother of Rauch, Tung and Striebel (1965) backwards; between two
// samples, with the bridge between their estimates.

namespace swarmsmith {
namespace {

using Eigen::Matrix2d;

constexpr double kNoise_m = 0.003;
constexpr double kNoise_rad = 0.02;

CycleKind kind_of(double gap_s, const TrackLimits& limits) {
  if (gap_s <= limits.measured_gap_s + kSameInstant_s) return CycleKind::Measured;
  if (gap_s <= limits.bridged_gap_s + kSameInstant_s) return CycleKind::Interpolated;
  if (gap_s <= limits.degraded_gap_s + kSameInstant_s) return CycleKind::Degraded;
  return CycleKind::Missing;
}

double squared(double value) {
  return value * value;
}

/// Transition of a position and its velocity over a time, without noise.
Matrix2d coasting(double time_s) {
  return Matrix2d{{1, time_s}, {0, 1}};
}

/// Covariance that white noise of unit intensity in the velocity adds over a time.
Matrix2d wandering(double time_s) {
  const double square = squared(time_s);
  return Matrix2d{{square * time_s / 3, square / 2}, {square / 2, time_s}};
}

/// A sample's variance, never 0, because the recursion divides by it.
double variance(double sigma) {
  constexpr double kLeast = 1e-6;
  return squared(std::max(sigma, kLeast));
}

/// Updates the covariance of a position and its velocity after the position was measured with this
/// variance. Returns the gain.
Eigen::Vector2d see(Matrix2d& covariance, double variance) {
  SWARMSMITH_ASSERT(covariance(0, 0) >= 0 && variance > 0, "variances are not negative");
  const Eigen::Vector2d gain = covariance.col(0) / (covariance(0, 0) + variance);
  // The variance of the position is computed as a product, so that rounding cannot make it
  // negative.
  const double left = variance / (covariance(0, 0) + variance);
  covariance(1, 1) -= gain(1) * covariance(0, 1);
  covariance(0, 0) *= left;
  covariance(0, 1) *= left;
  covariance(1, 0) = covariance(0, 1);
  return gain;
}

/// One coordinate at a time between two states: the weights of both states, and the remaining
/// covariance for noise of unit intensity.
struct Bridge {
  Matrix2d from;
  Matrix2d to;
  Matrix2d open;
};

Bridge bridge(double since_s, double until_s) {
  SWARMSMITH_ASSERT(since_s >= 0 && until_s >= 0 && since_s + until_s > 0, "a time lies between");
  const Matrix2d wandered = wandering(since_s);
  const Matrix2d onward = coasting(until_s);
  const Matrix2d at_end = onward * wandered * onward.transpose() + wandering(until_s);
  const Matrix2d to = wandered * onward.transpose() * at_end.inverse();
  return {.from = coasting(since_s) - to * coasting(since_s + until_s),
          .to = to,
          .open = wandered - to * at_end * to.transpose()};
}

/// Standard deviation of the position.
double sigma_of(const Bridge& bridge, const Matrix2d& from, const Matrix2d& to,
                const Matrix2d& both, double diffusion) {
  const Matrix2d cross = bridge.from * both * bridge.to.transpose();
  const Matrix2d covariance = bridge.from * from * bridge.from.transpose() +
                              bridge.to * to * bridge.to.transpose() + cross + cross.transpose() +
                              diffusion * bridge.open;
  return std::sqrt(std::max(0.0, covariance(0, 0)));
}

}  // namespace

bool is_reachable(const TimedPose& from, const TimedPose& to, const TrackLimits& limits) {
  const double duration = to.time_s - from.time_s;
  const double way = hypot(to.pose.x - from.pose.x, to.pose.y - from.pose.y);
  const double turn = std::fabs(wrap_angle(to.pose.theta - from.pose.theta));
  return way <= limits.top_speed_m_s * duration + kNoise_m &&
         turn <= limits.top_turn_rad_s * duration + kNoise_rad;
}

Motion::Motion(std::vector<TimedPose> track, const TrackLimits& limits)
    : track_(std::move(track)), limits_(limits), knots_(track_.size()) {
  SWARMSMITH_ASSERT(!track_.empty(), "a robot without samples has no track");
  for (std::size_t i = 0; i + 1 < track_.size(); ++i) {
    const double gap = track_[i + 1].time_s - track_[i].time_s;
    SWARMSMITH_ASSERT(gap >= 0, "a track is in the order of time");
    knots_[i].is_joined = kind_of(gap, limits_) != CycleKind::Missing &&
                          is_reachable(track_[i], track_[i + 1], limits_);
  }
  measure_diffusion();
  for (std::size_t first = 0; first < track_.size();) {
    std::size_t last = first;
    while (knots_[last].is_joined)
      ++last;
    SWARMSMITH_ASSERT(last < track_.size(), "nothing is joined to the last sample");
    smooth(first, last);
    first = last + 1;
  }
}

void Motion::measure_diffusion() {
  // Samples of cameras that alternate, or that nearly coincide in time, show nothing about
  // velocities.
  constexpr double kLeastApart_s = 0.015;
  const auto neighbour = [&](std::size_t i, std::ptrdiff_t step) -> std::optional<std::size_t> {
    for (auto k = static_cast<std::ptrdiff_t>(i); k + step >= 0;) {
      const std::ptrdiff_t joint = step < 0 ? k + step : k;
      if (!knots_[static_cast<std::size_t>(joint)].is_joined) return std::nullopt;
      k += step;
      const auto found = static_cast<std::size_t>(k);
      if (std::fabs(track_[found].time_s - track_[i].time_s) >= kLeastApart_s) return found;
    }
    return std::nullopt;
  };
  std::vector<Diffusion> at_knots(track_.size());
  Diffusion mean;
  int count = 0;
  double interval_s = 0;
  Diffusion noise_squares;
  for (std::size_t i = 0; i < track_.size(); ++i) {
    const auto before = neighbour(i, -1);
    const auto after = neighbour(i, 1);
    if (!before || !after) continue;
    const TimedPose& a = track_[*before];
    const TimedPose& b = track_[i];
    const TimedPose& c = track_[*after];
    const double first_s = b.time_s - a.time_s;
    const double second_s = c.time_s - b.time_s;
    // The variance of the velocities' difference is `units` times the diffusion, plus the samples'
    // noise.
    const double units = (first_s + second_s) / 3;
    const auto beyond_noise = [&](double change, double of_a, double of_b, double of_c) {
      const double noise = squared(of_a / first_s) + squared(of_b / first_s + of_b / second_s) +
                           squared(of_c / second_s);
      return std::max(0.0, squared(change) - noise) / units;
    };
    const double along_x = (c.pose.x - b.pose.x) / second_s - (b.pose.x - a.pose.x) / first_s;
    const double along_y = (c.pose.y - b.pose.y) / second_s - (b.pose.y - a.pose.y) / first_s;
    const double turning = wrap_angle(c.pose.theta - b.pose.theta) / second_s -
                           wrap_angle(b.pose.theta - a.pose.theta) / first_s;
    at_knots[i] = {beyond_noise(hypot(along_x, along_y) / std::numbers::sqrt2, a.sigma.sigma_m,
                                b.sigma.sigma_m, c.sigma.sigma_m),
                   beyond_noise(turning, a.sigma.sigma_rad, b.sigma.sigma_rad, c.sigma.sigma_rad)};
    interval_s += (first_s + second_s) / 2;
    noise_squares.place += variance(b.sigma.sigma_m);
    noise_squares.heading += variance(b.sigma.sigma_rad);
    mean.place += at_knots[i].place;
    mean.heading += at_knots[i].heading;
    ++count;
  }
  if (count == 0) {
    // Only the limits of the velocities are known: the velocities may change completely within a
    // second.
    for (Knot& knot : knots_)
      knot.diffusion = {squared(limits_.top_speed_m_s), squared(limits_.top_turn_rad_s)};
    return;
  }
  // Changes smaller than the noise cannot be detected. Noise is never averaged over more than the
  // next few samples, so that the robot's own curves are not smoothed.
  const double units = count * std::pow(interval_s / count, 3);
  const Diffusion always{mean.place / count + noise_squares.place / units,
                         mean.heading / count + noise_squares.heading / units};
  for (std::size_t i = 0; i + 1 < track_.size(); ++i) {
    const Diffusion& a = at_knots[i];
    const Diffusion& b = at_knots[i + 1];
    knots_[i].diffusion = {always.place + std::max(a.place, b.place),
                           always.heading + std::max(a.heading, b.heading)};
  }
}

void Motion::smooth(std::size_t first, std::size_t last) {
  struct Prediction {
    State state;
    Covariance covariance;
  };
  SWARMSMITH_ASSERT(first <= last && last < track_.size(), "a stretch has a sample");
  // Forwards: the prediction before each sample, then the estimate with it.
  std::vector<Prediction> predicted(last - first + 1);
  for (std::size_t i = first; i <= last; ++i) {
    Prediction& now = predicted[i - first];
    if (i == first) {
      now.state << track_[i].pose.x, track_[i].pose.y, track_[i].pose.theta, 0, 0, 0;
      // The initial velocity is unknown, so that the first gap is bridged by a straight line and
      // not with a robot that starts from rest.
      constexpr double kOpen = 100;
      now.covariance = {Eigen::Vector2d(1, squared(kOpen * limits_.top_speed_m_s)).asDiagonal(),
                        Eigen::Vector2d(1, squared(kOpen * limits_.top_turn_rad_s)).asDiagonal()};
    } else {
      const Knot& before = knots_[i - 1];
      const double gap = track_[i].time_s - track_[i - 1].time_s;
      const Matrix2d step = coasting(gap);
      const Matrix2d wandered = wandering(gap);
      now.state = step * before.state;
      now.covariance = {
          step * before.covariance.place * step.transpose() + before.diffusion.place * wandered,
          step * before.covariance.heading * step.transpose() +
              before.diffusion.heading * wandered};
    }
    Knot& knot = knots_[i];
    knot.state = now.state;
    knot.covariance = now.covariance;
    const TimedPose& seen = track_[i];
    const Eigen::Vector2d place_gain = see(knot.covariance.place, variance(seen.sigma.sigma_m));
    const Eigen::Vector2d turn_gain = see(knot.covariance.heading, variance(seen.sigma.sigma_rad));
    knot.state.col(0) += place_gain * (seen.pose.x - now.state(0, 0));
    knot.state.col(1) += place_gain * (seen.pose.y - now.state(0, 1));
    // Headings are unwrapped, so that turns are continuous.
    knot.state.col(2) += turn_gain * wrap_angle(seen.pose.theta - now.state(0, 2));
  }
  // Backwards: corrects each estimate with the later samples, by their differences from the
  // prediction.
  for (std::size_t i = last; i-- > first;) {
    Knot& knot = knots_[i];
    const Knot& next = knots_[i + 1];
    const Prediction& there = predicted[i + 1 - first];
    const Matrix2d step = coasting(track_[i + 1].time_s - track_[i].time_s);
    const auto go_back = [&](Matrix2d& here, const Matrix2d& foreseen, const Matrix2d& known,
                             Matrix2d& both) {
      const Matrix2d gain = here * step.transpose() * foreseen.inverse();
      here += gain * (known - foreseen) * gain.transpose();
      both = gain * known;
      return gain;
    };
    const State surprise = next.state - there.state;
    const Matrix2d place = go_back(knot.covariance.place, there.covariance.place,
                                   next.covariance.place, knot.with_next.place);
    const Matrix2d heading = go_back(knot.covariance.heading, there.covariance.heading,
                                     next.covariance.heading, knot.with_next.heading);
    knot.state.leftCols<2>() += place * surprise.leftCols<2>();
    knot.state.col(2) += heading * surprise.col(2);
  }
}

PoseAt Motion::between(std::size_t before, double time_s) const {
  SWARMSMITH_ASSERT(knots_[before].is_joined, "nothing is interpolated where no robot can go");
  const Knot& from = knots_[before];
  const Knot& to = knots_[before + 1];
  const double gap = track_[before + 1].time_s - track_[before].time_s;
  const Bridge over = bridge(time_s - track_[before].time_s, track_[before + 1].time_s - time_s);
  const State state = over.from * from.state + over.to * to.state;
  return {.pose = {state(0, 0), state(0, 1), wrap_angle(state(0, 2))},
          .sigma = {sigma_of(over, from.covariance.place, to.covariance.place, from.with_next.place,
                             from.diffusion.place),
                    sigma_of(over, from.covariance.heading, to.covariance.heading,
                             from.with_next.heading, from.diffusion.heading)},
          .kind = kind_of(gap, limits_),
          .gap_s = gap};
}

PoseAt Motion::held(const TimedPose& pose, double time_s, double gap_s) const {
  const double away = std::fabs(time_s - pose.time_s);
  return {.pose = pose.pose,
          .sigma = {std::hypot(pose.sigma.sigma_m, limits_.top_speed_m_s * away),
                    std::min(kPi, std::hypot(pose.sigma.sigma_rad, limits_.top_turn_rad_s * away))},
          .kind = CycleKind::Missing,
          .gap_s = gap_s};
}

PoseAt Motion::at(double time_s) const {
  const auto next =
      std::ranges::lower_bound(track_, time_s - kSameInstant_s, {}, &TimedPose::time_s);
  if (next == track_.end()) return held(track_.back(), time_s, 0);
  if (next->time_s <= time_s + kSameInstant_s) {
    return {next->pose, next->sigma, CycleKind::Measured, 0};
  }
  if (next == track_.begin()) return held(*next, time_s, 0);
  const auto before = static_cast<std::size_t>(next - track_.begin()) - 1;
  SWARMSMITH_ASSERT(track_[before].time_s < time_s && time_s < next->time_s, "it lies between");
  if (knots_[before].is_joined) return between(before, time_s);
  return held(track_[before], time_s, next->time_s - track_[before].time_s);
}

}  // namespace swarmsmith
