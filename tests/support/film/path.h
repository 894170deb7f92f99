#pragma once

#include <vector>

#include "sim/mission/pose.h"

namespace swarmsmith::film {

/// Where something is at any time: it stands at the first pose until `start_s`, then goes through
/// one pose each `step_s`, and stands at the last one. Between them cubic Hermite curves with
/// central differences as speeds, in x, y and the unwrapped heading; at the knots it is the pose
/// itself, so that a simulator's instants are true to the bit.
class Path {
 public:
  Path() = default;
  Path(std::vector<Pose> poses, double start_s = 0, double step_s = 0.1);

  Pose at(double time_s) const;
  double start_s() const { return start_s_; }
  double end_s() const;

 private:
  std::vector<Pose> knots_;  ///< headings unwrapped
  double start_s_ = 0;
  double step_s_ = 0.1;
};

}  // namespace swarmsmith::film
