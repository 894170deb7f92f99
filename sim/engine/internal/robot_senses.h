#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/rng.h"
#include "sim/control/reference_model.h"
#include "sim/engine/internal/beats.h"
#include "sim/engine/internal/motion_sensors.h"
#include "sim/engine/internal/noise_stream.h"
#include "sim/engine/internal/proximity_noise.h"
#include "sim/engine/internal/sensing.h"
#include "sim/engine/internal/sight.h"
#include "sim/engine/internal/world.h"
#include "sim/engine/profile.h"
#include "sim/engine/readings.h"
#include "sim/mission/arena.h"

namespace swarmsmith {

/// One robot's sensors in the simulated world, each computed when first asked for in a cycle.
///
/// Ground colour (thesis 4.2.1): the floor under the sensor, plus a bias of robot and run
/// and normal noise a channel, rounded, clamped to 0..255, then labelled (eq. 3.1, 3.2) where the
/// profile says so. Neighbours (thesis 5.1): by camera or from the lidar's clusters, less those
/// that are missed (thesis 7.1). The others: motion_sensors.h, light.h, proximity_noise.h, lidar.h.
///
/// Noise is counter-based: a reading's is a function of seed, robot, sensor, cycle and channel, so
/// that what is asked for, and when, changes no other reading (decided so that a machine that
/// ignores a sensor for a while meets the same noise as one that does not).
class RobotSenses final : public SimulatedSenses {
 public:
  /// The robot stands at its start. World, arena and profile must outlive the object.
  RobotSenses(const World& world, const Arena& arena, const Profile& profile, int robot,
              const Rng& run);

  /// From now on these are read in each cycle where they are made of several cycles' readings
  /// (GroundSensor::Reading::Vote, NeighbourSensor::Source::Radio): call it before the first one
  /// with all that will be asked for. Others are read when asked for.
  void remember(Sensors sensors);

  /// From now on ground sensors that vote give their own grey levels of the cycle instead, as the
  /// channels of the colour (epuck facts, section 5.2.1).
  void split_ground() { splits_ground_ = true; }

  /// A control cycle of this robot.
  struct Cycle {
    std::int64_t number = 0;  ///< counts from 1
    double time_s = 0;        ///< since the start
    Command acted;            ///< what the treads followed during the cycle that just ended
  };
  /// Forgets all readings.
  void begin_cycle(const Cycle& cycle) {
    cycle_.number = cycle.number;
    cycle_.time_s = cycle.time_s;
    // No sensor feels what LEDs show.
    cycle_.acted.left_mps = cycle.acted.left_mps;
    cycle_.acted.right_mps = cycle.acted.right_mps;
    computed_ = held_;
    if (!remembered_.empty()) [[unlikely]]
      read(remembered_);
  }

  /// When it next reads what it holds from one beat to the next; Beats::kNever when it holds
  /// nothing.
  std::int64_t next_beat() const { return std::min(ground_hold_.next, neighbour_hold_.next); }
  /// Reads what has a beat at `now`, before the control cycle of that sub-step. The noise of such a
  /// reading is of its number, the start's being 0, in place of the cycle's.
  void read_at_beat(std::int64_t now);

  const ProximityReadings& proximity() override;
  FrontProximity front_proximity() override;
  const Rgb& ground_color() override;
  std::span<const Neighbour> neighbours() override;
  int neighbour_count() override;
  const LightReadings& light() override;
  double time_s() override { return cycle_.time_s; }

  const Readings& read(Sensors sensors) override;

  /// What was computed in this cycle so far.
  Sensors computed() const { return computed_; }

 private:
  /// A sensor that is read at beats, and when.
  struct Hold {
    Beats beats;
    std::int64_t next;  ///< Beats::kNever for a sensor that is read in each cycle
    std::int64_t readings = 0;
  };
  bool has_beat(Sensor sensor, Hold& hold, std::int64_t now);
  /// What becomes of distances on the way to the control software.
  void distort(std::span<double> proximity) const;
  /// Whether the sensor has not been read in this cycle; it counts as read from now on.
  bool is_due(Sensor sensor);
  void read_strengths();
  void count_votes();
  void receive_packets();
  /// What the ground sensor makes of the floor in this cycle, by its bias and noise.
  void blur(const Rgb& floor, Rgb& ground) const;
  void read_motion(Sensors sensors);
  void read_lidar();
  void round_scan(std::span<double> ranges_m) const;
  void drop_missed_neighbours();

  const World* world_;
  const Arena* arena_;
  const Profile* profile_;
  int robot_;
  Sight sight_;
  MotionSensors motion_;
  ProximityRays proximity_rays_;
  ProximityNoise proximity_noise_;
  NoiseStream strength_noise_;
  NoiseStream ground_noise_;
  NoiseStream light_noise_;
  NoiseStream lidar_noise_;
  NoiseStream neighbour_misses_;
  bool distorts_proximity_;
  bool is_vote_;         ///< the ground is GroundSensor::Reading::Vote
  Point ground_sensor_;  ///< the first place of the robot's GroundSensor
  Hold ground_hold_;
  Hold neighbour_hold_;
  Sensors held_;                    ///< those that are read at beats
  double ground_bias_ = 0;          ///< of this robot in this run, on all channels
  double neighbour_miss_rate_ = 0;  ///< of this robot in this run
  Cycle cycle_;
  Sensors computed_;  ///< the others' readings are of an earlier cycle
  Readings readings_;
  RayDistances front_m_{};    ///< front_proximity's, whose first ones are readings
  std::vector<int> room_;     ///< for numbers of movers
  std::vector<int> between_;  ///< the same, while room_ is in use
  Point floor_place_;         ///< where the floor was last looked up, and what colour it has there
  Rgb floor_;
  std::vector<double> turret_ranges_m_;  ///< the scan that finds neighbours, if it is the lidar

  Sensors remembered_;
  bool splits_ground_ = false;
  /// How many points were black, and white, in each of the last cycles, and in all of them.
  struct Votes {
    int black = 0;
    int white = 0;
  };
  std::vector<Votes> votes_;
  Votes vote_;
  /// How many of the packets in `readings_.neighbours` came in each of the last cycles.
  std::vector<int> packets_;
};

}  // namespace swarmsmith
