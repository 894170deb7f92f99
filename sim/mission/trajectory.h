#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sim/mission/mission.h"
#include "sim/mission/pose.h"

namespace swarmsmith {

/// Poses of a swarm, and of the movable objects around it, at the global instants 0.1 s, 0.2 s, ...
/// of a run, without the start. Recorded by a simulator or measured with a camera.
struct Trajectory {
  int robots = 0;
  std::vector<Pose> poses;  ///< instant by instant, each with all robots in a fixed order
  int objects = 0;
  std::vector<Pose> object_poses;  ///< instant by instant, in the order of the arena

  int instants() const {
    return robots == 0 ? 0 : static_cast<int>(poses.size() / static_cast<std::size_t>(robots));
  }
  /// The robots' poses at an instant, counted from 0.
  std::span<const Pose> at(int instant) const;
  std::span<const Pose> objects_at(int instant) const;

  friend bool operator==(const Trajectory&, const Trajectory&) = default;
};

/// The mission's score of the whole trajectory; larger is better. The numbers of robots, objects
/// and instants are taken from the trajectory. Throws std::invalid_argument when an instant is
/// incomplete.
double score_of(const Mission& mission, const Instance& instance, const Trajectory& trajectory);

}  // namespace swarmsmith
