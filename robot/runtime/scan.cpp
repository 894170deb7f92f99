#include "robot/runtime/scan.h"

#include <cmath>
#include <limits>

#include "base/assert.h"
#include "base/math.h"

namespace swarmsmith {
namespace {

/// No lidar starts at a larger angle; beyond it, a turn would be lost in rounding.
constexpr double kMostAngle_rad = 1e6;
/// Half an increment, plus the rounding error of angles sent as float32.
constexpr double kFarthest = 0.5 + 1e-3;

/// The index of the value nearest to a ray, whose position is `place` values after the first one;
/// `turn` values are a full turn. In a tie, the earlier value.
std::optional<std::size_t> nearest(double place, double turn, std::size_t values) {
  SWARMSMITH_ASSERT(values > 0 && turn > 0 && std::isfinite(place), "the scan was checked");
  const auto last = static_cast<double>(values - 1);
  std::optional<std::size_t> found;
  double least = kFarthest;
  place -= std::floor((place + kFarthest) / turn) * turn;  // the first turn in which it can reach a
                                                           // value
  while (place <= last + kFarthest) {
    const double index = std::fmin(std::fmax(std::floor(place + 0.5), 0), last);
    const double distance = std::fabs(place - index);
    if (distance < least) {
      least = distance;
      found = static_cast<std::size_t>(index);
    }
    place += turn;
  }
  return found;
}

}  // namespace

std::optional<std::string> resample(const ScanMessage& scan, double turn_rad, RayRanges& ranges_m) {
  const double increment = scan.angle_increment_rad;
  if (scan.ranges_m.empty()) return "a scan without values";
  if (!std::isfinite(scan.angle_min_rad)) return "a scan whose angle_min is not a number";
  if (std::fabs(scan.angle_min_rad) > kMostAngle_rad)
    return "a scan whose angle_min is too large for an angle";
  if (!(std::fabs(increment) > 1e-5 && std::fabs(increment) < 1))
    return "a scan with an angle_increment of " + std::to_string(increment) + " rad";
  const double turn = 2 * kPi / std::fabs(increment);
  for (int ray = 0; ray < kLidarRays; ++ray) {
    double& range = ranges_m[static_cast<std::size_t>(ray)];
    range = std::numeric_limits<double>::infinity();
    const double angle = 2 * kPi * ray / kLidarRays - turn_rad;
    const auto index =
        nearest((angle - scan.angle_min_rad) / increment, turn, scan.ranges_m.size());
    if (!index) continue;
    SWARMSMITH_ASSERT(*index < scan.ranges_m.size(), "the nearest value is one of the scan's");
    const double value = scan.ranges_m[*index];
    // false for NaN, as required
    if (value > 0 && value >= scan.range_min_m && value <= scan.range_max_m) range = value;
  }
  return std::nullopt;
}

}  // namespace swarmsmith
