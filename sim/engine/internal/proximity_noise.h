#pragma once

#include <array>
#include <span>

#include "sim/engine/internal/noise_stream.h"
#include "sim/engine/internal/rays.h"
#include "sim/engine/profile.h"

namespace swarmsmith {

/// The errors of one robot's proximity sensors (thesis 4.2.9, 7.1; thesis facts, section 13).
class ProximityNoise {
 public:
  /// Draws the numbers that are fixed for the run: the miss rates of the sensors. `sensing` must
  /// outlive the object.
  ProximityNoise(const ProximitySensing& sensing, const Rng& run, int robot, std::size_t sensors);

  /// Converts physical distances to readings. A reading is a phantom, uniform in [0.05 m, R]
  /// whatever the distance; or a missed hit, +infinity; or a finite distance times N(1, scale_sd)
  /// plus N(0, sd). The sensor's limits apply before and after. `readings` holds the first sensors
  /// or all of them.
  void apply(std::span<double> readings, std::int64_t cycle) const;

 private:
  double read(double distance_m, std::size_t sensor, std::uint64_t index) const;

  const ProximitySensing* sensing_;
  std::uint64_t per_cycle_;  ///< numbers of each stream
  bool ideal_;               ///< only the limits apply
  bool only_normal_;         ///< only the limits and N(0, sd) apply
  NoiseStream normal_;
  NoiseStream scale_;
  NoiseStream miss_;
  NoiseStream phantom_;
  std::array<double, kMostRingSensors> miss_rates_{};
};

}  // namespace swarmsmith
