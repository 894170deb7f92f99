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

/// Where the rays of a robot with this body start, from its centre.
inline double ray_start_m(const ProximityRing& ring, const Form& robot) {
  if (ring.start_m > 0) return ring.start_m;
  return robot.is_rvr ? kRayStart_m : robot.inradius_m;
}

/// Distances along the proximity directions from the ray's start to what it meets; +infinity where
/// nothing was met. Physical distances: limits and noise come later.
using RayDistances = std::array<double, kProximitySensors>;

/// The rays of `self` along kProximityDirections, which start `start_m` from its centre, as if
/// there were only walls: all are replaced. Hits beyond `range_m` may be left out. A ray that
/// starts behind the face of a wall reads 0.
void meet_walls(const Body& self, double start_m, const Walls& walls, double range_m,
                RayDistances& distances);

/// The same for any ring, which also says what a ray reads that starts behind a face.
void meet_walls(const Body& self, const Ring& ring, double start_m, const Walls& walls,
                double range_m, RayDistances& distances);

/// Shortens the rays where they meet a solid of any form. A ray that starts inside of it does not
/// meet it (simulator facts, section 4.1).
void meet_solid(const Body& self, const Ring& ring, double start_m, const Form& form,
                const Body& at, double range_m, RayDistances& distances);

/// The same for two RVRs, quicker.
void meet_robot(const Body& self, const Body& other, double range_m, RayDistances& distances);

/// Centres farther apart than this cannot matter to meet_robot.
constexpr double sight_of_robots_m(double range_m) {
  return kRayStart_m + range_m + kCornerRadius_m;
}

/// Readings as the sensor gives them: -infinity below the blind zone, +infinity beyond the range.
inline double limited(double distance_m, double range_m) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double seen = distance_m > range_m ? kInfinity : distance_m;
  return distance_m < kBlindZone_m ? -kInfinity : seen;
}

}  // namespace swarmsmith
