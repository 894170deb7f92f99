#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace swarmsmith {

/// The reference model of the RVR (thesis table 5.1): the readings and commands of control
/// software. It is the interface between control software and a simulator or a robot; both sides
/// keep to the ranges below and use SI units. Frame: x forward, y left, angles counter-clockwise.

inline constexpr int kProximitySensors = 8;

/// Another robot may have up to this number of proximity sensors, and of light sensors.
inline constexpr int kMostRingSensors = 24;

/// The name of this reference model in flavours.
inline constexpr std::string_view kRvrModel = "rvr";
/// Those of robots whose proximity sensors give strengths, as the e-puck's (docs/flavours.md).
inline constexpr std::array<std::string_view, 3> kStrengthModels = {"rm1.1", "rm1.2", "rm1-2018"};

/// Directions of the proximity sensors from the robot's head, in degrees, by index
/// (argos3-rvr; rvr-automode facts, section 3.1).
inline constexpr std::array<int, kProximitySensors> kProximityDirections_deg = {45,   0,   -45, -90,
                                                                                -135, 180, 135, 90};

/// The number of sensors that look ahead; they come first. The others look to a side or back.
inline constexpr int kFrontSensors = 3;

/// A proximity sensor cannot measure smaller distances: then prox is 1 (thesis 4.2.9).
inline constexpr double kBlindZone_m = 0.05;
/// R, the distance at which prox becomes 0 by default. A profile may set another range for its
/// sensors, and a flavour for the sensors that it expects (thesis facts, section 5).
inline constexpr double kProximityRange_m = 0.4;
/// The highest reading of a light sensor (thesis 4.2.6).
inline constexpr double kMostLight_lux = 16'000;
/// Robots nearer than this are neighbours: farther away the lidar may see walls of the room (thesis
/// 5.1). Table 5.1 has 10 m, the range of the variable.
inline constexpr double kNeighbourRange_m = 0.75;

/// One control cycle, nominally (thesis facts, section 9: 1200 cycles are 120 s).
inline constexpr double kControlPeriod_s = 0.1;

struct Rgb {
  std::uint8_t r = 0;
  std::uint8_t g = 0;
  std::uint8_t b = 0;

  friend bool operator==(const Rgb&, const Rgb&) = default;
};

/// Another robot, as this robot sees it: the distance of its centre (from a lidar, of the near side
/// of its turret), and the unit vector towards it in the robot's frame.
struct Neighbour {
  double distance_m = 0;
  double direction_x = 1;
  double direction_y = 0;
};

/// Distances to the nearest obstacle, one per sensor of the robot, in metres from the sensor:
/// -infinity if closer than `kBlindZone_m`, +infinity beyond the range R or without an obstacle. A
/// flavour computes prox of table 5.1 from them (`obstacle_strength`). There are at least eight: a
/// robot with fewer sensors reads nothing with the others.
using ProximityReadings = std::span<const double>;

/// The distances of the sensors that look ahead.
using FrontProximity = std::span<const double, kFrontSensors>;

/// Lux at each light sensor of the robot, up to `kMostLight_lux`, and at least eight numbers. The
/// RVR does not have this ring of sensors; `chocolate` needs it, along the eight directions of the
/// proximity sensors (thesis facts, section 6.1).
using LightReadings = std::span<const double>;

/// Readings of the current cycle. They are computed on request, so that a sensor that no module
/// uses costs nothing; two requests in the same cycle give the same reading.
class Senses {
 public:
  virtual ~Senses() = default;
  virtual ProximityReadings proximity() = 0;
  /// The same for the front of the RVR's ring alone; it may be cheaper to compute than all eight.
  virtual FrontProximity front_proximity() {
    return FrontProximity(proximity().data(), kFrontSensors);
  }
  /// Colour of the floor under the ground sensor, 0.05 m ahead of the centre.
  virtual const Rgb& ground_color() = 0;
  /// The robots nearer than `kNeighbourRange_m` (thesis 5.1, lidar clustering), in a fixed order.
  virtual std::span<const Neighbour> neighbours() = 0;
  /// The number of robots seen or heard in this cycle; `neighbours` may also include robots from
  /// earlier cycles.
  virtual int neighbour_count() { return static_cast<int>(neighbours().size()); }
  virtual LightReadings light() = 0;
  /// Time since the start by the robot's clock, in seconds.
  virtual double time_s() = 0;
};

/// Two in front, one on each side, one at the back (thesis 3.1); black is off.
using Leds = std::array<Rgb, 5>;

/// Speeds of the treads over the ground in metres per second, and the colours of the LEDs.
struct Command {
  double left_mps = 0;
  double right_mps = 0;
  Leds leds{};

  friend bool operator==(const Command&, const Command&) = default;
};

/// Wheels go up to 155 cm/s, in both directions (thesis table 5.1; thesis facts, section 5).
inline constexpr double kMaxWheelSpeed_mps = 1.55;

/// The highest speed that files of robots and flavours may give.
inline constexpr double kFastestWheel_mps = 10;

/// The speed, limited to the range of the wheels.
constexpr double within_wheel_speed(double speed_mps, double most_mps = kMaxWheelSpeed_mps) {
  if (speed_mps > most_mps) return most_mps;
  return speed_mps < -most_mps ? -most_mps : speed_mps;
}

/// A line of table 5.1, in SI units.
struct ReferenceEntry {
  std::string_view device;
  std::string_view variable;
  std::string_view unit;  ///< empty for a number without a unit
  double least = 0;
  double most = 0;
  bool below_most = false;  ///< `most` itself is excluded
  int count = 0;            ///< 0: one per neighbour
};

/// Table 5.1 as the code above implements it: wheels turn both ways (thesis facts, section 5), the
/// light is the ring's, and the LEDs, which the table leaves out, come last.
std::span<const ReferenceEntry> reference_model();

}  // namespace swarmsmith
