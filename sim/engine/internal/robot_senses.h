#pragma once

#include <cstdint>
#include <vector>

#include "base/rng.h"
#include "sim/control/reference_model.h"
#include "sim/engine/internal/world.h"
#include "sim/engine/profile.h"
#include "sim/engine/readings.h"
#include "sim/mission/arena.h"

namespace swarmsmith {

/// The place of the ground sensor, ahead of the centre (rvr-automode facts, section 3.2).
inline constexpr double kGroundSensorAhead_m = 0.05;

/// One robot's sensors in the simulated world, each computed when first asked for in a cycle.
///
/// Noise is counter-based: a reading's is a function of seed, robot, sensor, cycle and channel, so
/// that what is asked for, and when, changes no other reading (decided so that a machine that
/// ignores a sensor for a while meets the same noise as one that does not).
class RobotSenses final : public Senses {
 public:
  /// World, arena and profile must outlive the object.
  RobotSenses(const World& world, const Arena& arena, const Profile& profile, int robot,
              const Rng& run);

  /// A control cycle of this robot.
  struct Cycle {
    std::int64_t number = 0;  ///< counts from 1
    double time_s = 0;        ///< since the start
    Command acted;            ///< what the treads followed during the cycle that just ended
  };
  /// Forgets all readings.
  void begin_cycle(const Cycle& cycle);

  const ProximityReadings& proximity() override;
  Rgb ground_color() override;
  std::span<const Neighbour> neighbours() override;
  const LightReadings& light() override;
  double time_s() override { return cycle_.time_s; }

  /// The sensors' readings of this cycle; what control asked for is not read again.
  const Readings& read(Sensors sensors);

 private:
  const World* world_;
  const Arena* arena_;
  const Profile* profile_;
  int robot_;
  std::uint64_t proximity_noise_;  ///< keys of the streams
  std::uint64_t ground_noise_;
  Cycle cycle_;
  bool has_proximity_ = false;
  bool has_ground_ = false;
  bool has_neighbours_ = false;
  ProximityReadings proximity_{};
  Rgb ground_;
  Point floor_place_;  ///< where the floor was last looked up, and what colour it has there
  Rgb floor_;
  std::vector<Neighbour> neighbours_;
  LightReadings light_{};
  Readings readings_;
};

}  // namespace swarmsmith
