#include "tests/sim/engine/open_loop.h"

#include <algorithm>

#include "base/math.h"
#include "sim/engine/internal/world.h"

namespace swarmsmith {
namespace {

double smallest_gap(const World& world) {
  double gap = 1;
  for (int i = 0; i < world.robots(); ++i) {
    for (int j = i + 1; j < world.robots(); ++j)
      gap = std::min(gap, gap_between(world.body(i), world.body(j)));
    for (const WallPlane& wall : world.walls().planes)
      gap = std::min(gap, gap_to(world.body(i), wall));
  }
  return gap;
}

std::array<Pose, 3> poses_of(const World& world) {
  return {pose_of(world.body(0)), pose_of(world.body(1)), pose_of(world.body(2))};
}

}  // namespace

OpenLoop drive_again(const LoggedRun& log) {
  std::array<Pose, 3> starts;
  for (std::size_t robot = 0; robot < 3; ++robot)
    starts[robot] = log[0][robot].pose;
  World world(dodecagon_of_the_thesis(), rvr(), starts, ContactModel::Exact);
  OpenLoop result{.poses = {starts}, .first_contact = static_cast<int>(log.size()) - 1};
  bool touched = false;
  for (std::size_t tick = 1; tick < log.size(); ++tick) {
    for (std::size_t robot = 0; robot < 3; ++robot) {
      const LoggedTick& before = log[tick - 1][robot];
      world.command(static_cast<int>(robot), {before.left_cmps / 100, before.right_cmps / 100});
    }
    world.advance(kSubStepsPerInstant);
    result.poses.push_back(poses_of(world));
    if (!touched && smallest_gap(world) <= 0) {
      touched = true;
      result.first_contact = static_cast<int>(tick);
    }
    for (std::size_t robot = 0; robot < 3; ++robot) {
      const Pose& truth = log[tick][robot].pose;
      const Pose& ours = result.poses.back()[robot];
      const double off = hypot(ours.x - truth.x, ours.y - truth.y);
      result.worst_of_all_m = std::max(result.worst_of_all_m, off);
      if (!touched) result.worst_m = std::max(result.worst_m, off);
    }
  }
  return result;
}

}  // namespace swarmsmith
