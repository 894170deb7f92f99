#include "sim/mission/trajectory.h"

#include <stdexcept>

namespace swarmsmith {
namespace {

/// The poses of group `number`, with `size` poses per group.
std::span<const Pose> group(std::span<const Pose> poses, int number, int size) {
  const auto count = static_cast<std::size_t>(size);
  return poses.subspan(static_cast<std::size_t>(number) * count, count);
}

void set_points(std::span<const Pose> poses, std::vector<Point>& points) {
  points.clear();
  for (const Pose& pose : poses)
    points.push_back(pose.position());
}

}  // namespace

std::span<const Pose> Trajectory::at(int instant) const {
  return group(poses, instant, robots);
}

std::span<const Pose> Trajectory::objects_at(int instant) const {
  return group(object_poses, instant, objects);
}

double score_of(const Mission& mission, const Instance& instance, const Trajectory& trajectory) {
  const int instants = trajectory.instants();
  const auto complete = [&](const std::vector<Pose>& poses, int count) {
    return poses.size() == static_cast<std::size_t>(instants) * static_cast<std::size_t>(count);
  };
  if (!complete(trajectory.poses, trajectory.robots)) {
    throw std::invalid_argument("an instant of the trajectory lacks robots");
  }
  if (!complete(trajectory.object_poses, trajectory.objects)) {
    throw std::invalid_argument("an instant of the trajectory lacks objects");
  }
  Scorer scorer(mission.rule, arena_of(mission, instance));
  std::vector<Point> robots;
  std::vector<Point> objects;
  for (int i = 0; i < instants; ++i) {
    set_points(trajectory.at(i), robots);
    set_points(trajectory.objects_at(i), objects);
    scorer.observe(robots, objects);
  }
  return scorer.score();
}

}  // namespace swarmsmith
