#include "tracking/motion/resampling.h"

#include <algorithm>
#include <cmath>

#include "base/assert.h"
#include "base/math.h"

namespace swarmsmith {
namespace {

constexpr double kNoise_m = 0.003;
constexpr double kNoise_rad = 0.02;

Pose between(const TimedPose& from, const TimedPose& to, double time_s) {
  const double share = (time_s - from.time_s) / (to.time_s - from.time_s);
  const double turn = wrap_angle(to.pose.theta - from.pose.theta);
  return {from.pose.x + share * (to.pose.x - from.pose.x),
          from.pose.y + share * (to.pose.y - from.pose.y),
          wrap_angle(from.pose.theta + share * turn)};
}

CycleKind kind_of(double gap_s, const TrackLimits& limits) {
  if (gap_s <= limits.measured_gap_s + kSameInstant_s) return CycleKind::Measured;
  if (gap_s <= limits.bridged_gap_s + kSameInstant_s) return CycleKind::Interpolated;
  if (gap_s <= limits.degraded_gap_s + kSameInstant_s) return CycleKind::Degraded;
  return CycleKind::Missing;
}

}  // namespace

bool is_reachable(const TimedPose& from, const TimedPose& to, const TrackLimits& limits) {
  const double duration = to.time_s - from.time_s;
  const double way = hypot(to.pose.x - from.pose.x, to.pose.y - from.pose.y);
  const double turn = std::fabs(wrap_angle(to.pose.theta - from.pose.theta));
  return way <= limits.top_speed_m_s * duration + kNoise_m &&
         turn <= limits.top_turn_rad_s * duration + kNoise_rad;
}

PoseAt pose_at(std::span<const TimedPose> track, double time_s, const TrackLimits& limits) {
  SWARMSMITH_ASSERT(!track.empty(), "a robot without samples has no track");
  const auto next =
      std::ranges::lower_bound(track, time_s - kSameInstant_s, {}, &TimedPose::time_s);
  if (next == track.end()) return {track.back().pose, CycleKind::Missing, 0};
  if (next->time_s <= time_s + kSameInstant_s) return {next->pose, CycleKind::Measured, 0};
  if (next == track.begin()) return {next->pose, CycleKind::Missing, 0};
  const TimedPose& before = *std::prev(next);
  const double gap = next->time_s - before.time_s;
  const CycleKind kind = kind_of(gap, limits);
  if (kind == CycleKind::Missing || !is_reachable(before, *next, limits)) {
    return {before.pose, CycleKind::Missing, gap};
  }
  return {between(before, *next, time_s), kind, gap};
}

}  // namespace swarmsmith
