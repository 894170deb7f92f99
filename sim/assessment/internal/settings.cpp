#include "sim/assessment/internal/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/assert.h"
#include "base/math.h"
#include "base/rng.h"

namespace swarmsmith::assessment {
namespace {

/// The law of the missions' placement, in the smallest disc that holds every such group: the
/// corners of a triangle with sides of 0.7 m lie 0.7 / sqrt 3 = 0.404 m from its centre.
Pose draw_pose(Rng& rng) {
  constexpr double kRadius_m = 0.404;
  const double radius = kRadius_m * std::max(rng.uniform(), rng.uniform());
  const SinCos direction = sin_cos(rng.uniform(0, 2 * kPi));
  return {radius * direction.cos, radius * direction.sin, wrap_angle(rng.uniform(0, 2 * kPi))};
}

bool is_group(const std::vector<Pose>& poses) {
  for (std::size_t i = 0; i < poses.size(); ++i) {
    for (std::size_t j = i + 1; j < poses.size(); ++j) {
      const double distance = hypot(poses[i].x - poses[j].x, poses[i].y - poses[j].y);
      if (distance < kNearestPair_m || distance > kFarthestPair_m) return false;
    }
  }
  return true;
}

}  // namespace

Mission mission_in(Arena arena) {
  return {.name = "assessment",
          .arena = std::move(arena),
          .shuffled = {},
          .robots = kRobots,
          .cycles = kCycles,
          .rule = RobotsOn{}};
}

std::vector<Pose> starts_anywhere(const Mission& mission, std::int64_t seed) {
  Expected<Instance> instance = instance_of(mission, seed);
  SWARMSMITH_ASSERT(instance.has_value(), "three robots fit into the thesis' arena");
  return std::move(instance->starts);
}

std::vector<Pose> starts_in_a_group(std::int64_t seed) {
  Rng rng = Rng(static_cast<std::uint64_t>(seed)).split("group");
  std::vector<Pose> poses(kRobots);
  do {
    std::ranges::generate(poses, [&rng] { return draw_pose(rng); });
  } while (!is_group(poses));
  return poses;
}

void watch(const Trial& trial, std::vector<Pose> starts, std::int64_t seed,
           const Recorder& recorder) {
  const Instance instance{.starts = std::move(starts), .patches = {}};
  simulate({.controller = trial.machine,
            .flavour = trial.flavour,
            .profile = trial.profile,
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
