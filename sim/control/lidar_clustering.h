#pragma once

#include <array>
#include <span>
#include <vector>

#include "sim/control/reference_model.h"

namespace swarmsmith {

/// The rays of the YDLIDAR X4 (thesis 4.2.10): the first points straight ahead, the others follow
/// counter-clockwise, 2 pi / 719 apart (thesis facts, section 3).
inline constexpr int kLidarRays = 719;

struct RayDirection {
  double x = 1;  ///< unit vector in the robot's frame
  double y = 0;
};

/// Directions of the rays, by index.
const std::array<RayDirection, kLidarRays>& lidar_directions();

/// The rules for finding neighbours in a scan (thesis 5.1; thesis facts, section 4).
struct LidarClustering {
  /// Readings outside these bounds are dropped; the upper bound keeps walls of the room from being
  /// taken for robots.
  double least_distance_m = 0.10;
  double most_distance_m = kNeighbourRange_m;
  /// A reading belongs to the same cluster as the previous kept reading when both differences are
  /// below these thresholds.
  double distance_threshold_m = 0.02;
  double angle_threshold_deg = 10;
  /// Clusters with fewer points are dropped (rvr-automode facts, section 3.3).
  int fewest_points = 5;
};

/// Finds the robots in a scan: consecutive readings that are close to each other are one robot, at
/// the mean of their distances and the circular mean of their angles. The last cluster is joined to
/// the first one when it is within the same thresholds across the seam.
///
/// `ranges_m` are kLidarRays distances from the lidar's axis; infinity means that no object is in
/// range. The content of `found` is replaced by the robots, counter-clockwise from the robot's
/// head; a robot that lies across the seam comes first.
void cluster_lidar(std::span<const double> ranges_m, std::vector<Neighbour>& found,
                   const LidarClustering& law = {});

}  // namespace swarmsmith
