#include "sim/control/lidar_clustering.h"

#include <cmath>

#include "base/assert.h"
#include "base/math.h"

namespace swarmsmith {
namespace {

/// A reading within the bounds.
struct Echo {
  int ray = 0;
  double distance_m = 0;
};

/// Consecutive readings that are close to each other.
struct Cluster {
  Echo first;
  Echo last;
  int points = 0;
  double distances_m = 0;  ///< sum
  double x = 0;            ///< sum of the rays' unit vectors
  double y = 0;

  void add(const Echo& echo) {
    if (points == 0) first = echo;
    last = echo;
    ++points;
    distances_m += echo.distance_m;
    const RayDirection& direction = lidar_directions()[static_cast<std::size_t>(echo.ray)];
    x += direction.x;
    y += direction.y;
  }

  Neighbour neighbour() const {
    const double length = hypot(x, y);
    Neighbour neighbour{.distance_m = distances_m / points};
    if (length > 0) {
      neighbour.direction_x = x / length;
      neighbour.direction_y = y / length;
    }
    return neighbour;
  }
};

/// Whether a reading is close to the previous kept reading, which is `rays` rays earlier.
bool close(const Echo& echo, const Echo& before, int rays, const LidarClustering& law) {
  return std::fabs(echo.distance_m - before.distance_m) < law.distance_threshold_m &&
         rays * 360.0 / kLidarRays < law.angle_threshold_deg;
}

Cluster joined(Cluster earlier, const Cluster& later) {
  earlier.last = later.last;
  earlier.points += later.points;
  earlier.distances_m += later.distances_m;
  earlier.x += later.x;
  earlier.y += later.y;
  return earlier;
}

}  // namespace

const std::array<RayDirection, kLidarRays>& lidar_directions() {
  static const std::array<RayDirection, kLidarRays> directions = [] {
    std::array<RayDirection, kLidarRays> made;
    for (int ray = 0; ray < kLidarRays; ++ray) {
      const SinCos angle = sin_cos(2 * kPi * ray / kLidarRays);
      made[static_cast<std::size_t>(ray)] = {angle.cos, angle.sin};
    }
    return made;
  }();
  return directions;
}

void cluster_lidar(std::span<const double> ranges_m, std::vector<Neighbour>& found,
                   const LidarClustering& law) {
  SWARMSMITH_ASSERT(ranges_m.size() == kLidarRays, "a scan has a distance for each ray");
  std::vector<Cluster> clusters;
  for (int ray = 0; ray < kLidarRays; ++ray) {
    const Echo echo = {ray, ranges_m[static_cast<std::size_t>(ray)]};
    if (!(echo.distance_m >= law.least_distance_m && echo.distance_m <= law.most_distance_m)) {
      continue;
    }
    if (clusters.empty() ||
        !close(echo, clusters.back().last, ray - clusters.back().last.ray, law)) {
      clusters.emplace_back();
    }
    clusters.back().add(echo);
  }
  if (clusters.size() > 1) {
    const Cluster& last = clusters.back();
    Cluster& first = clusters.front();
    const int across_the_seam = first.first.ray + kLidarRays - last.last.ray;
    if (close(first.first, last.last, across_the_seam, law)) {
      first = joined(last, first);
      clusters.pop_back();
    }
  }
  found.clear();
  for (const Cluster& cluster : clusters) {
    if (cluster.points >= law.fewest_points) found.push_back(cluster.neighbour());
  }
}

}  // namespace swarmsmith
