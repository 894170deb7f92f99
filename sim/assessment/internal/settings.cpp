#include "sim/assessment/internal/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/assert.h"
#include "base/math.h"
#include "base/rng.h"

namespace swarmsmith::assessment {
namespace {

/// 1 for the RVR. Robots that detect others only at a shorter range start closer together; the
/// arena is the same.
double group_scale(const Robot& robot) {
  if (robot.neighbours.range_m == 0) return 1;  // it does not detect others
  return std::min(1.0, robot.neighbours.range_m / kNeighbourRange_m);
}

/// The same distribution as the missions' placement, in the smallest disc that holds every such
/// group: the corners of a triangle with sides of 0.7 m are 0.7 / sqrt 3 = 0.404 m from its centre.
Pose draw_pose(Rng& rng, double scale) {
  const double radius = scale * 0.404 * std::max(rng.uniform(), rng.uniform());
  const SinCos direction = sin_cos(rng.uniform(0, 2 * kPi));
  return {radius * direction.cos, radius * direction.sin, wrap_angle(rng.uniform(0, 2 * kPi))};
}

bool is_group(const std::vector<Pose>& poses, const PairDistances& pairs) {
  for (std::size_t i = 0; i < poses.size(); ++i) {
    for (std::size_t j = i + 1; j < poses.size(); ++j) {
      const double distance = hypot(poses[i].x - poses[j].x, poses[i].y - poses[j].y);
      if (distance < pairs.nearest_m || distance > pairs.farthest_m) return false;
    }
  }
  return true;
}

}  // namespace

Mission mission_in(Arena arena, const Robot& robot) {
  return {.name = "assessment",
          .arena = std::move(arena),
          .shuffled = {},
          .robots = kRobots,
          .robot = robot,
          .cycles = kCycles,
          .rule = RobotsOn{}};
}

std::vector<Pose> starts_anywhere(const Mission& mission, std::int64_t seed) {
  Expected<Instance> instance = instance_of(mission, seed);
  SWARMSMITH_ASSERT(instance.has_value(), "three robots fit into the thesis' arena");
  return std::move(instance->starts);
}

PairDistances pairs_of(const Robot& robot) {
  const double scale = group_scale(robot);
  return {.nearest_m = scale * 0.5, .farthest_m = scale * 0.7};
}

std::vector<Pose> starts_in_a_group(const Robot& robot, std::int64_t seed) {
  const double scale = group_scale(robot);
  const PairDistances pairs = pairs_of(robot);

  Rng rng = Rng(static_cast<std::uint64_t>(seed)).split("group");
  std::vector<Pose> poses(kRobots);
  do {
    std::ranges::generate(poses, [&] { return draw_pose(rng, scale); });
  } while (!is_group(poses, pairs));
  return poses;
}

void watch(const Trial& trial, std::vector<Pose> starts, std::int64_t seed,
           const Recorder& recorder) {
  const Instance instance{.starts = std::move(starts), .patches = {}};
  simulate({.controller = trial.machine,
            .flavour = trial.subject.flavour,
            .profile = trial.subject.profile,
            .mission = trial.mission,
            .instance = instance,
            .seed = seed},
           recorder);
}

std::string range_text(const std::vector<double>& values, int digits) {
  const auto [least, most] = std::ranges::minmax(values);
  const std::string low = fmt::format("{:.{}f}", least, digits);
  const std::string high = fmt::format("{:.{}f}", most, digits);
  return low == high ? low : low + " to " + high;
}

}  // namespace swarmsmith::assessment
