#pragma once

#include <algorithm>
#include <array>
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

/// The sensors of one robot in the simulated world; each is computed when first requested in a
/// cycle.
///
/// Ground colour (thesis 4.2.1): the floor under the sensor, plus a bias per robot and run and
/// normal noise per channel, rounded, clamped to 0..255, then labelled (eq. 3.1, 3.2) if the
/// profile says so. Neighbours (thesis 5.1): from a camera or from clusters of the lidar, without
/// those that are missed (thesis 7.1). The others: motion_sensors.h, light.h, proximity_noise.h,
/// lidar.h.
///
/// Noise is counter-based: the noise of a reading is a function of seed, robot, sensor, cycle and
/// channel, so that requesting a reading, or not, changes no other reading. A machine that ignores
/// a sensor for a while thus gets the same noise as one that does not.
class RobotSenses final : public SimulatedSenses {
 public:
  /// The robot must be at its start pose. World, arena and profile must outlive the object. With
  /// `splits_ground`, ground sensors that vote give their individual grey levels of the cycle
  /// instead, as the channels of the colour (epuck facts, section 5.2.1).
  RobotSenses(const World& world, const Arena& arena, const Profile& profile, int robot,
              const Rng& run, bool splits_ground = false);

  /// From now on these sensors are read in each cycle if their readings combine several cycles
  /// (GroundSensor::Reading::Vote, NeighbourSensor::Source::Radio). Call it before the first cycle
  /// with all sensors that will be requested. Other sensors are read on request.
  void remember(Sensors sensors);

  /// One control cycle of this robot.
  struct Cycle {
    std::int64_t number = 0;  ///< counted from 1
    double time_s = 0;        ///< since the start
    Command acted;            ///< command that the treads followed during the cycle that just ended
  };
  /// Starts a cycle and discards all readings.
  void begin_cycle(const Cycle& cycle) {
    cycle_.number = cycle.number;
    cycle_.time_s = cycle.time_s;
    // LEDs are left out: no sensor depends on them.
    cycle_.acted.left_mps = cycle.acted.left_mps;
    cycle_.acted.right_mps = cycle.acted.right_mps;
    computed_ = held_;
    if (!remembered_.empty()) [[unlikely]]
      read(remembered_);
  }

  /// The next time at which it reads sensors that hold their values between beats; Beats::kNever
  /// without such sensors.
  std::int64_t next_beat() const { return std::min(ground_hold_.next, neighbour_hold_.next); }
  /// Reads the sensors that have a beat at `now`, before the control cycle of that sub-step. The
  /// noise of such a reading depends on its number, 0 at the start, instead of the cycle.
  void read_at_beat(std::int64_t now);

  ProximityReadings proximity() override;
  FrontProximity front_proximity() override;
  const Rgb& ground_color() override;
  std::span<const Neighbour> neighbours() override;
  int neighbour_count() override;
  LightReadings light() override;
  double time_s() override { return cycle_.time_s; }

  const Readings& read(Sensors sensors) override;

  /// The sensors that were computed in this cycle so far.
  Sensors computed() const { return computed_; }

 private:
  /// A sensor that is read at beats, with the time of the next beat.
  struct Hold {
    Beats beats;
    std::int64_t next;  ///< Beats::kNever for a sensor that is read in each cycle
    std::int64_t readings = 0;
  };
  bool has_beat(Sensor sensor, Hold& hold, std::int64_t now);
  /// Applies to distances the errors that arise on the way to the control software.
  void distort(std::span<double> proximity) const;
  /// Whether the sensor has not been read in this cycle; marks it as read.
  bool is_due(Sensor sensor);
  void read_strengths();
  void count_votes();
  void receive_packets();
  /// The output of the ground sensor for this floor in this cycle, with its bias and noise.
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
  bool is_vote_;         ///< the ground sensor is of the kind GroundSensor::Reading::Vote
  Point ground_sensor_;  ///< the first point of the robot's GroundSensor
  Hold ground_hold_;
  Hold neighbour_hold_;
  Sensors held_;                    ///< the sensors that are read at beats
  double ground_bias_ = 0;          ///< of this robot in this run, the same for all channels
  double neighbour_miss_rate_ = 0;  ///< of this robot in this run
  Cycle cycle_;
  Sensors computed_;  ///< the other sensors have readings of an earlier cycle
  Readings readings_;
  RayDistances proximity_m_{};
  std::array<double, kMostRingSensors> light_lux_{};
  RayDistances front_m_{};    ///< for front_proximity; only the first values are readings
  std::vector<int> room_;     ///< for indices of movers
  std::vector<int> between_;  ///< a second one, while room_ is in use
  Point floor_place_;         ///< place where the floor was last looked up; floor_ is the colour
                              ///< there
  Rgb floor_;
  std::vector<double> turret_ranges_m_;  ///< the scan in which neighbours are found, if the source
                                         ///< is the lidar

  Sensors remembered_;
  bool splits_ground_;
  /// The number of black and of white points in each of the last cycles, and in all of them.
  struct Votes {
    int black = 0;
    int white = 0;
  };
  std::vector<Votes> votes_;
  Votes vote_;
  /// The number of packets in `readings_.neighbours` that were received in each of the last cycles.
  std::vector<int> packets_;
};

}  // namespace swarmsmith
