#include "sim/engine/internal/ring.h"

#include <algorithm>

#include "base/assert.h"
#include "base/math.h"

namespace swarmsmith {
namespace {

Ring label_ring(const ProximityRing& ring) {
  return ring_of(ring.labels_deg.empty() ? ring.rays_deg : ring.labels_deg);
}

}  // namespace

Ring ring_of(const RingAngles& angles_deg) {
  SWARMSMITH_ASSERT(angles_deg.size() <= kMostRingSensors, "files with more are refused");
  Ring ring;
  for (const double angle_deg : angles_deg) {
    const double angle_rad = angle_deg * kPi / 180;
    const SinCos angle = sin_cos(angle_rad);
    ring.angles_rad[ring.count] = wrap_angle(angle_rad);
    ring.directions[ring.count++] = {angle.cos, angle.sin};
  }
  ring.readings = std::max(ring.readings, ring.count);
  ring.is_rvr = angles_deg == ProximityRing::rvr_ring();
  if (ring.is_rvr) std::ranges::copy(kProximityDirections, ring.directions.begin());
  return ring;
}

RingDirections directions_of(const Ring& ring) {
  return {ring.directions.begin(), ring.directions.begin() + ring.readings};
}

std::optional<RingDirections> labels_of(const Robot& robot) {
  const Ring labels = label_ring(robot.proximity);
  if (labels == ring_of(ProximityRing::rvr_ring())) return std::nullopt;
  return directions_of(labels);
}

bool has_own_lights(const Robot& robot) {
  return !robot.light.angles_deg.empty() &&
         ring_of(robot.light.angles_deg) != label_ring(robot.proximity);
}

}  // namespace swarmsmith
