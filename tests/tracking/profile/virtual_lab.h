#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/engine/profile.h"
#include "tracking/profile/lab_profile.h"

namespace swarmsmith {

/// A laboratory whose truth is known: the simulator with a profile, and a camera that sees
/// its robots between control cycles, at its own rate, with the noise of a good one.
struct VirtualLab {
  Profile truth;
  /// Explores, and turns where something is ahead.
  std::string machine = "--nstates 1 --s0 0 --rwm0 30";
  std::string mission = "aggregation";
  double rate_hz = 15;
  double noise_m = 0.0005;
  double noise_rad = 0.003;
  double heading_off_rad = 0;
  double pushed_m = 0;        ///< so far robots are pushed along x in the second after 60 s
  bool tells_latency = true;  ///< it takes most of the time; all else can do without

  /// A run's robots, measured.
  std::vector<MeasuredRobot> run(std::int64_t seed) const;
  /// Those of several runs.
  std::vector<MeasuredRobot> runs(int count, std::int64_t first_seed = 1) const;
};

/// `rvr`, to be changed.
Profile rvr_profile();

}  // namespace swarmsmith
