#pragma once

#include <array>
#include <limits>

#include "sim/control/reference_model.h"
#include "sim/engine/internal/body.h"
#include "sim/engine/internal/form.h"
#include "sim/engine/internal/ring.h"
#include "sim/engine/internal/walls.h"
#include "sim/robot/robot.h"

namespace swarmsmith {

/// Distance from the centre at which the rays of a robot with this body start.
inline double ray_start_m(const ProximityRing& ring, const Form& robot) {
  if (ring.start_m > 0) return ring.start_m;
  return robot.is_rvr ? kRayStart_m : robot.inradius_m;
}

/// Distances from the start of each ray of a ring to the first hit; +infinity for rays without a
/// hit. These are physical distances, without limits and noise. The others are left as they are.
using RayDistances = std::array<double, kMostRingSensors>;

/// Computes the rays of `self` along kProximityDirections, which start `start_m` from its centre,
/// as if there were only walls; replaces all distances. Hits beyond `range_m` may be left out. A
/// ray that starts behind the face of a wall reads 0.
void meet_walls(const Body& self, double start_m, const Walls& walls, double range_m,
                RayDistances& distances);

/// The same for any ring; the ring defines the reading of a ray that starts behind a face.
void meet_walls(const Body& self, const Ring& ring, double start_m, const Walls& walls,
                double range_m, RayDistances& distances);

/// Shortens the rays that hit a solid of any shape. A ray that starts inside the solid does not hit
/// it (simulator facts, section 4.1).
void meet_solid(const Body& self, const Ring& ring, double start_m, const Form& form,
                const Body& at, double range_m, RayDistances& distances);

/// The same for two RVRs, but faster.
void meet_robot(const Body& self, const Body& other, double range_m, RayDistances& distances);

/// Robots whose centres are farther apart than this cannot affect meet_robot.
constexpr double sight_of_robots_m(double range_m) {
  return kRayStart_m + range_m + kCornerRadius_m;
}

/// The reading that the sensor gives for a distance: -infinity below the blind zone, +infinity
/// beyond the range.
inline double limited(double distance_m, double range_m) {
  constexpr double kUnseen = std::numeric_limits<double>::infinity();
  const double seen = distance_m > range_m ? kUnseen : distance_m;
  return distance_m < kBlindZone_m ? -kUnseen : seen;
}

}  // namespace swarmsmith
