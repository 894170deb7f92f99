#include "tracking/motion/internal/robot_track.h"

#include <algorithm>
#include <cmath>

#include "base/assert.h"
#include "base/math.h"

namespace swarmsmith {
namespace {

/// The poses of a robot from one camera.
struct CameraTrack {
  std::vector<TimedPose> poses;  ///< with the standard deviations of their noise
  Scatter sigma;                 ///< of one pose, with systematic errors
  double systematic_m = 0;
};

std::vector<CameraTrack> camera_tracks(const TaggedRobot& robot, const RobotSamples& samples,
                                       std::span<const TrackedCamera> cameras) {
  std::vector<CameraTrack> tracks(cameras.size());
  for (const Sample& sample : samples.samples) {
    if (sample.use != Sample::Use::Used) continue;
    SWARMSMITH_ASSERT(static_cast<std::size_t>(sample.camera) < tracks.size(),
                      "sightings of cameras that are lost were left out");
    tracks[static_cast<std::size_t>(sample.camera)].poses.push_back({sample.time_s, sample.pose});
  }
  for (std::size_t c = 0; c < tracks.size(); ++c) {
    CameraTrack& track = tracks[c];
    // The motion model needs the noise alone. Errors of calibrations are the same in successive
    // samples, so they are added only afterwards.
    const Scatter noise = scatter_of(track.poses);
    for (TimedPose& pose : track.poses)
      pose.sigma = noise;
    track.systematic_m = std::hypot(cameras[c].place_error_m, robot.offset_sigma_m);
    track.sigma = {std::hypot(noise.sigma_m, track.systematic_m), noise.sigma_rad};
  }
  return tracks;
}

/// The heading interpolated between the neighbours of an instant; outside of the track, the nearest
/// heading.
double heading_between(const std::vector<TimedPose>& track, double time_s) {
  SWARMSMITH_ASSERT(!track.empty(), "a person adds to what cameras saw");
  const auto next = std::ranges::lower_bound(track, time_s, {}, &TimedPose::time_s);
  if (next == track.end()) return track.back().pose.theta;
  if (next == track.begin()) return next->pose.theta;
  const TimedPose& before = *std::prev(next);
  const double share = (time_s - before.time_s) / (next->time_s - before.time_s);
  const double turn = wrap_angle(next->pose.theta - before.pose.theta);
  return wrap_angle(before.pose.theta + share * turn);
}

/// The points that people marked, on the plane of the robot's tag. A person is precise to a few
/// pixels.
std::vector<TimedPose> by_hand(const TaggedRobot& robot, const std::vector<TimedPose>& track,
                               std::span<const TrackedCamera> cameras,
                               const std::vector<HandPoint>& points) {
  constexpr double kHit_px = 3;
  constexpr double kSaid_rad = 0.1;
  constexpr double kGuessed_rad = 0.5;
  std::vector<TimedPose> made;
  for (const HandPoint& point : points) {
    if (point.robot != robot.setup.name) continue;
    const auto camera = std::ranges::find_if(cameras, [&](const TrackedCamera& one) {
      return one.name == point.camera || (point.camera.empty() && cameras.size() == 1);
    });
    if (camera == cameras.end()) continue;
    const std::vector<ImagePoint> pixels{point.middle, {point.middle.u + 1, point.middle.v}};
    // The neighbouring pixel gives the size of a pixel at this place.
    const std::vector<Point> places = on_plane(camera->view, pixels, robot.setup.height_m);
    const double pixel_m = hypot(places[1].x - places[0].x, places[1].y - places[0].y);
    const double heading =
        point.heading_deg ? *point.heading_deg * kPi / 180 : heading_between(track, point.time_s);
    const Pose tag{places[0].x, places[0].y, wrap_angle(heading + robot.offset.yaw_rad)};
    made.push_back({point.time_s,
                    robot_pose(tag, robot.offset),
                    // An error of three pixels (docs/tracking.md, "Points by hand").
                    {kHit_px * pixel_m, point.heading_deg ? kSaid_rad : kGuessed_rad}});
  }
  return made;
}

/// Whether the track has samples so close before and after a time that what lies between them
/// counts as measured.
bool is_seen_at(const std::vector<TimedPose>& track, double time_s, const TrackLimits& limits) {
  const auto next = std::ranges::lower_bound(track, time_s, {}, &TimedPose::time_s);
  if (next == track.end()) return false;
  if (next->time_s == time_s) return true;
  if (next == track.begin()) return false;
  return next->time_s - std::prev(next)->time_s <= limits.measured_gap_s + kSameInstant_s;
}

struct Estimate {
  Pose pose;
  Scatter sigma;
};

/// The weighted mean of several estimates; a single one is returned unchanged.
Estimate fused(const std::vector<Estimate>& estimates) {
  SWARMSMITH_ASSERT(!estimates.empty(), "there is a measurement to fuse");
  // Exactly: with one camera the score must not depend on the rounding of a mean.
  if (estimates.size() == 1) return estimates.front();
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
    // Angles are averaged as differences from the first one, which are small.
    sum.theta += turn_weight * wrap_angle(estimate.pose.theta - first.theta);
  }
  return {{sum.x / weights, sum.y / weights, wrap_angle(first.theta + sum.theta / turn_weights)},
          {1 / std::sqrt(weights), 1 / std::sqrt(turn_weights)}};
}

void note_disagreement(const std::vector<Estimate>& estimates, double time_s, RobotTrack& track) {
  if (estimates.size() > 1) ++track.compared;
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
  std::vector<std::pair<const CameraTrack*, Motion>> motions;
  for (const CameraTrack& track : tracks) {
    for (const TimedPose& pose : track.poses)
      made.merged.push_back({pose.time_s, pose.pose, track.sigma});
    for (std::size_t i = 1; i < track.poses.size(); ++i) {
      // Of one camera: between two cameras, a step may be their disagreement.
      if (is_reachable(track.poses[i - 1], track.poses[i], options.limits)) continue;
      made.breaks.emplace_back(track.poses[i - 1], track.poses[i]);
    }
    if (track.poses.empty()) continue;
    made.sigma.sigma_m = std::max(made.sigma.sigma_m, track.sigma.sigma_m);
    made.sigma.sigma_rad = std::max(made.sigma.sigma_rad, track.sigma.sigma_rad);
    made.noise_m = std::max(made.noise_m, track.poses.front().sigma.sigma_m);
    motions.emplace_back(&track, Motion(track.poses, options.limits));
  }
  SWARMSMITH_ASSERT(!made.merged.empty(), "a robot that was never seen is an error before");
  std::ranges::stable_sort(made.merged, {}, &TimedPose::time_s);
  std::vector<TimedPose> points = by_hand(robot, made.merged, cameras, options.points);
  std::erase_if(points, [&](const TimedPose& point) {
    // A person's point does not replace a measurement.
    const bool is_seen = is_seen_at(made.merged, point.time_s, options.limits);
    (is_seen ? made.unneeded_s : made.by_hand_s).push_back(point.time_s);
    return is_seen;
  });
  made.merged.insert(made.merged.end(), points.begin(), points.end());
  std::ranges::stable_sort(made.merged, {}, &TimedPose::time_s);
  const Motion together(made.merged, options.limits);
  const auto add = [&](const Estimate& estimate, CycleKind kind) {
    made.poses.push_back(estimate.pose);
    made.sigmas.push_back(estimate.sigma);
    made.kinds.push_back(kind);
  };
  for (int cycle = 0; cycle <= options.span.cycles; ++cycle) {
    const double time = instant_s(cycle);
    // Only measurements: an interpolation over one camera's gap would make another camera's
    // measurement worse.
    std::vector<Estimate> measured;
    for (const auto& [track, motion] : motions) {
      const PoseAt found = motion.at(time);
      if (found.kind != CycleKind::Measured) continue;
      measured.push_back(
          {found.pose,
           {std::hypot(found.sigma.sigma_m, track->systematic_m), found.sigma.sigma_rad}});
    }
    if (measured.empty()) {
      // A gap of one camera may contain samples of another one, and both together make it shorter.
      const PoseAt found = together.at(time);
      // A point that a person marked bridges a gap, but does not count as measured.
      const bool is_by_hand = std::ranges::any_of(made.by_hand_s, [&](double point_s) {
        return std::fabs(point_s - time) <= std::max(found.gap_s, options.limits.measured_gap_s);
      });
      add({found.pose, found.sigma},
          is_by_hand ? std::max(found.kind, CycleKind::Interpolated) : found.kind);
      continue;
    }
    note_disagreement(measured, time, made);
    add(fused(measured), CycleKind::Measured);
  }
  SWARMSMITH_ASSERT(made.poses.size() == static_cast<std::size_t>(options.span.cycles) + 1,
                    "a pose at the start and one after each cycle");
  SWARMSMITH_ASSERT(made.disagreeing <= made.compared, "only what is compared can disagree");
  return made;
}

}  // namespace swarmsmith
