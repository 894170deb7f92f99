#include "sim/mission/trajectory.h"

#include <stdexcept>

namespace swarmsmith {

std::span<const Pose> Trajectory::at(int instant) const {
  const auto count = static_cast<std::size_t>(robots);
  return std::span(poses).subspan(static_cast<std::size_t>(instant) * count, count);
}

double score_of(const Mission& mission, const Instance& instance, const Trajectory& trajectory) {
  const auto robots = static_cast<std::size_t>(trajectory.robots);
  const bool complete =
      robots == 0 ? trajectory.poses.empty() : trajectory.poses.size() % robots == 0;
  if (!complete) throw std::invalid_argument("an instant of the trajectory lacks robots");
  Scorer scorer(mission.rule, arena_of(mission, instance));
  std::vector<Point> points(robots);
  for (int instant = 0; instant < trajectory.instants(); ++instant) {
    const std::span<const Pose> poses = trajectory.at(instant);
    for (std::size_t i = 0; i < robots; ++i)
      points[i] = poses[i].position();
    scorer.observe(points);
  }
  return scorer.score();
}

}  // namespace swarmsmith
