#include "tracking/motion/internal/robot_track.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"

namespace swarmsmith {
namespace {

struct CameraTrack {
  std::vector<TimedPose> poses;
  Scatter sigma;
};

/// Independent errors add up as squares.
double root_of_squares(double a, double b, double c) {
  return std::sqrt(a * a + b * b + c * c);
}

std::vector<CameraTrack> camera_tracks(const TaggedRobot& robot, const RobotSamples& samples,
                                       std::span<const TrackedCamera> cameras) {
  std::vector<CameraTrack> tracks(cameras.size());
  for (const Sample& sample : samples.samples) {
    if (sample.use != Sample::Use::Used) continue;
    tracks[static_cast<std::size_t>(sample.camera)].poses.push_back({sample.time_s, sample.pose});
  }
  for (std::size_t c = 0; c < tracks.size(); ++c) {
    Scatter& sigma = tracks[c].sigma;
    sigma = scatter_of(tracks[c].poses);
    sigma.sigma_m = root_of_squares(sigma.sigma_m, cameras[c].place_error_m, robot.offset_sigma_m);
  }
  return tracks;
}

struct Estimate {
  Pose pose;
  Scatter sigma;
};

/// One estimate keeps its bits.
Pose fused(const std::vector<Estimate>& estimates) {
  if (estimates.size() == 1) return estimates.front().pose;
  const Pose& first = estimates.front().pose;
  double weights = 0;
  double turn_weights = 0;
  Pose sum;
  for (const Estimate& estimate : estimates) {
    const double weight = 1 / (estimate.sigma.sigma_m * estimate.sigma.sigma_m);
    const double turn_weight = 1 / (estimate.sigma.sigma_rad * estimate.sigma.sigma_rad);
    weights += weight;
    turn_weights += turn_weight;
    sum.x += weight * estimate.pose.x;
    sum.y += weight * estimate.pose.y;
    sum.theta += turn_weight * wrap_angle(estimate.pose.theta - first.theta);
  }
  return {sum.x / weights, sum.y / weights, wrap_angle(first.theta + sum.theta / turn_weights)};
}

void note_disagreement(const std::vector<Estimate>& estimates, double time_s, RobotTrack& track) {
  double worst = 0;
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    for (std::size_t j = i + 1; j < estimates.size(); ++j) {
      const Pose& a = estimates[i].pose;
      const Pose& b = estimates[j].pose;
      worst = std::max(worst, hypot(a.x - b.x, a.y - b.y));
    }
  }
  if (worst > kDisagree_m) ++track.disagreeing;
  if (worst <= track.worst_disagreement_m) return;
  track.worst_disagreement_m = worst;
  track.worst_disagreement_at_s = time_s;
}

}  // namespace

RobotTrack track_of(const TaggedRobot& robot, const RobotSamples& samples,
                    std::span<const TrackedCamera> cameras, const TrackOptions& options) {
  const std::vector<CameraTrack> tracks = camera_tracks(robot, samples, cameras);
  RobotTrack made;
  for (const CameraTrack& track : tracks) {
    made.merged.insert(made.merged.end(), track.poses.begin(), track.poses.end());
    for (std::size_t i = 1; i < track.poses.size(); ++i) {
      if (is_reachable(track.poses[i - 1], track.poses[i], options.limits)) continue;
      made.breaks.emplace_back(track.poses[i - 1], track.poses[i]);
    }
    if (track.poses.empty()) continue;
    made.sigma.sigma_m = std::max(made.sigma.sigma_m, track.sigma.sigma_m);
    made.sigma.sigma_rad = std::max(made.sigma.sigma_rad, track.sigma.sigma_rad);
  }
  std::ranges::stable_sort(made.merged, {}, &TimedPose::time_s);
  for (int cycle = 0; cycle <= options.span.cycles; ++cycle) {
    const double time = instant_s(cycle);
    std::vector<Estimate> measured;
    for (const CameraTrack& track : tracks) {
      if (track.poses.empty()) continue;
      const PoseAt found = pose_at(track.poses, time, options.limits);
      if (found.kind == CycleKind::Measured) measured.push_back({found.pose, track.sigma});
    }
    if (measured.empty()) {
      const PoseAt found = pose_at(made.merged, time, options.limits);
      made.poses.push_back(found.pose);
      made.kinds.push_back(found.kind);
      continue;
    }
    note_disagreement(measured, time, made);
    made.poses.push_back(fused(measured));
    made.kinds.push_back(CycleKind::Measured);
  }
  return made;
}

}  // namespace swarmsmith
