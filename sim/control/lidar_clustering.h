#pragma once

#include <array>
#include <span>
#include <vector>

#include "sim/control/reference_model.h"

namespace swarmsmith {

/// The YDLIDAR X4's rays (thesis 4.2.10): the first straight ahead, the others counter-clockwise,
/// 2 pi / 719 apart (thesis facts, section 3).
inline constexpr int kLidarRays = 719;

struct RayDirection {
  double x = 1;  ///< unit vector in the robot's frame
  double y = 0;
};

/// Directions of the rays, by index.
const std::array<RayDirection, kLidarRays>& lidar_directions();

/// How a scan becomes neighbours (thesis 5.1; thesis facts, section 4).
struct LidarClustering {
  /// Readings outside of these are dropped; the farther bound so that the walls of the room are not
  /// taken for robots.
  double least_distance_m = 0.10;
  double most_distance_m = kNeighbourRange_m;
  /// A reading belongs to the cluster of the kept reading before it when it differs by less.
  double distance_threshold_m = 0.02;
  double angle_threshold_deg = 10;
  /// Smaller clusters are dropped (rvr-automode facts, section 3.3).
  int fewest_points = 5;
};

/// The robots that a scan sees: consecutive readings that are close to each other are one robot, at
/// the mean of their distances and the circular mean of their angles. The last cluster goes on in
/// the first one when the same thresholds hold across the seam.
///
/// `ranges_m` are kLidarRays distances from the lidar's axis; infinities are readings without an
/// object in range. Replaces what was in `found`: the robots counter-clockwise from the head, one
/// that lies across the seam first.
void cluster_lidar(std::span<const double> ranges_m, std::vector<Neighbour>& found,
                   const LidarClustering& law = {});

}  // namespace swarmsmith
