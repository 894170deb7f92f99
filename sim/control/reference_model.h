#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace swarmsmith {

/// The reference model of the RVR (thesis table 5.1): what control software may read and command.
/// It is the border between control software and whatever carries it, a simulator or a robot: both
/// keep to the ranges below, and both give SI units. Frame: x forward, y left, angles
/// counter-clockwise.

inline constexpr int kProximitySensors = 8;

/// Its name, which flavours have for it.
inline constexpr std::string_view kRvrModel = "rvr";

/// Directions of the proximity sensors from the robot's head, in degrees, by index
/// (argos3-rvr; rvr-automode facts, section 3.1).
inline constexpr std::array<int, kProximitySensors> kProximityDirections_deg = {45,   0,   -45, -90,
                                                                                -135, 180, 135, 90};

/// So many of them, the first ones, look ahead; the others look to a side or back.
inline constexpr int kFrontSensors = 3;

/// A proximity sensor cannot measure what is nearer: then prox is 1 (thesis 4.2.9).
inline constexpr double kBlindZone_m = 0.05;
/// R, where prox becomes 0, unless a user tunes it: a profile for its sensors, a flavour for what
/// it expects of them (thesis facts, section 5).
inline constexpr double kProximityRange_m = 0.4;
/// Of a light sensor (thesis 4.2.6).
inline constexpr double kMostLight_lux = 16'000;
/// Robots nearer than this are neighbours: beyond it the lidar may see walls of the room (thesis
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

/// Another robot, as seen from this one: distance of its centre (by lidar, of its turret's near
/// side), and the unit vector towards it in the robot's frame.
struct Neighbour {
  double distance_m = 0;
  double direction_x = 1;
  double direction_y = 0;
};

/// Distances to the nearest obstacle along the eight directions, in metres from the sensor:
/// -infinity closer than `kBlindZone_m`, +infinity beyond the range R or with nothing there. prox
/// of table 5.1 is what a flavour makes of them (`obstacle_strength`).
using ProximityReadings = std::array<double, kProximitySensors>;

/// Those of the sensors that look ahead.
using FrontProximity = std::span<const double, kFrontSensors>;

/// Lux at the eight directions of the proximity sensors, up to `kMostLight_lux`; a ring of sensors
/// that the RVR lacks and `chocolate` wants (thesis facts, section 6.1).
using LightReadings = std::array<double, kProximitySensors>;

/// Readings of the current cycle. A source computes what is asked for, so a sensor that no module
/// asks for costs nothing; asking twice in a cycle gives the same reading.
class Senses {
 public:
  virtual ~Senses() = default;
  virtual const ProximityReadings& proximity() = 0;
  /// The same to the front alone, for who needs no more: a source may have less to do.
  virtual FrontProximity front_proximity() {
    return FrontProximity(proximity().data(), kFrontSensors);
  }
  /// Colour of the floor under the ground sensor, 0.05 m ahead of the centre.
  virtual const Rgb& ground_color() = 0;
  /// The robots nearer than `kNeighbourRange_m` (thesis 5.1, lidar clustering), in a fixed order.
  virtual std::span<const Neighbour> neighbours() = 0;
  /// How many robots were seen or heard in this very cycle; `neighbours` may know older ones, too.
  virtual int neighbour_count() { return static_cast<int>(neighbours().size()); }
  virtual const LightReadings& light() = 0;
  /// Time since the start as the robot's clock has it, seconds.
  virtual double time_s() = 0;
};

/// Two in front, one on each side, one at the back (thesis 3.1); black is off.
using Leds = std::array<Rgb, 5>;

/// Speeds of the treads over ground, metres per second, and what the LEDs show.
struct Command {
  double left_mps = 0;
  double right_mps = 0;
  Leds leds{};

  friend bool operator==(const Command&, const Command&) = default;
};

/// Wheels go up to 155 cm/s, either way (thesis table 5.1; thesis facts, section 5).
inline constexpr double kMaxWheelSpeed_mps = 1.55;

/// As far as files of robots and flavours may go.
inline constexpr double kFastestWheel_mps = 10;

/// A speed within the wheels' range.
constexpr double within_wheel_speed(double speed_mps, double most_mps = kMaxWheelSpeed_mps) {
  if (speed_mps > most_mps) return most_mps;
  return speed_mps < -most_mps ? -most_mps : speed_mps;
}

/// A line of table 5.1, in SI units.
struct ReferenceEntry {
  std::string_view device;
  std::string_view variable;
  std::string_view unit;  ///< empty for a pure number
  double least = 0;
  double most = 0;
  bool below_most = false;  ///< `most` itself is left out
  int count = 0;            ///< 0: one a neighbour
};

/// Table 5.1 as the code above has it: wheels turn both ways (thesis facts, section 5), light is
/// the ring's, and the LEDs, which the table leaves out, stand at its end.
std::span<const ReferenceEntry> reference_model();

}  // namespace swarmsmith
