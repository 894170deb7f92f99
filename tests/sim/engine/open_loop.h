#pragma once

#include <array>
#include <vector>

#include "sim/mission/pose.h"
#include "tests/sim/engine/reference_data.h"

namespace swarmsmith {

/// A recorded run driven again by its own commands, and by nothing else of the log than its start.
struct OpenLoop {
  std::vector<std::array<Pose, 3>> poses;  ///< [tick][robot]
  /// The first tick at whose end two robots, or a robot and a wall, touched; the number of
  /// ticks when there is none.
  int first_contact = 0;
  double worst_m = 0;         ///< largest distance from the log before that
  double worst_of_all_m = 0;  ///< the same up to the end
};
OpenLoop drive_again(const LoggedRun& log);

}  // namespace swarmsmith
