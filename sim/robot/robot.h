#pragma once

#include <array>
#include <string>
#include <vector>

#include "sim/control/reference_model.h"
#include "sim/control/treads.h"
#include "sim/robot/outline.h"
#include "sim/robot/rvr.h"

namespace swarmsmith {

/// A robot as data: what it is made of, one struct a device. Plain values; what a device falls
/// short of is a profile's (sim/engine/profile.h), what control software makes of readings is a
/// flavour's. SI units; the robot's frame has x forward and y left. Each default is the RVR's.

/// A rigid body on the floor.
struct RobotBody {
  Outline outline = BoxOutline{kBodySide_m, kBodySide_m};
  double height_m = kBodyHeight_m;
  double mass_kg = kMass_kg;
  double inertia_kg_m2 = 0;  ///< around the vertical axis; 0: that of a plate of its outline
  /// Of a contact; restitution is 0.
  double robot_friction = kFriction;  ///< with another robot
  double wall_friction = kFriction;   ///< with a wall or anything else

  friend bool operator==(const RobotBody&, const RobotBody&) = default;
};

/// Two wheels or treads on one axis through the centre.
struct RobotDrive {
  double track_m = kTreadDistance_m;  ///< from one to the other
  double max_speed_mps = kMaxWheelSpeed_mps;
  /// Of the whole drive, towards the speed and the spin that were commanded.
  double max_force_N = kMaxForce_N;
  double max_torque_Nm = kMaxTorque_Nm;

  friend bool operator==(const RobotDrive&, const RobotDrive&) = default;
};

/// Angles from the robot's head, degrees, counter-clockwise, by index; up to kProximitySensors.
using RingAngles = std::vector<double>;

/// Rays around the robot; a ray begins on a circle around the centre.
struct ProximityRing {
  /// What a sensor says of the distance to what its ray meets.
  enum class Reading {
    Distance,  ///< the distance itself, up to the range that a profile gives
    /// a + b d + c d^2 within [0, 1], and 0 beyond `reach_m`. A ray that starts inside of something
    /// does not meet it, be it a wall.
    Strength,
  };
  RingAngles rays_deg = rvr_ring();
  RingAngles labels_deg;  ///< what control software takes them for; empty: where they are
  double start_m = 0;     ///< the circle's radius; 0: it is inscribed in the body
  double height_m = kProximityHeight_m;
  Reading reading = Reading::Distance;
  /// Of Strength.
  double reach_m = 0;
  std::array<double, 3> law = {0, 0, 0};  ///< a, b (1/m) and c (1/m^2)

  static RingAngles rvr_ring();
  friend bool operator==(const ProximityRing&, const ProximityRing&) = default;
};

/// Light sensors around the robot.
struct LightRing {
  enum class Reading {
    /// I / d^2 from the sensor's place, times the cosine of the horizontal angle to the light.
    Lux,
    /// exp(-2 rho) (1 - 2 angle / pi), rho = d / I up to 2.5, within [0, 1]
    Strength,
  };
  RingAngles angles_deg;              ///< empty: as the proximity rays
  double out_m = kLightSensorsOut_m;  ///< where light is looked for: so far from the robot's axis
  double height_m = kLightSensorsHeight_m;
  Reading reading = Reading::Lux;

  friend bool operator==(const LightRing&, const LightRing&) = default;
};

/// Looks at the floor.
struct GroundSensor {
  enum class Reading {
    Color,  ///< RGB under the one point
    /// Black, gray or white: grey levels in [0, 1] of all points in the last `vote_ticks` control
    /// cycles are counted. More than `vote_majority` below `black_below` are black, as many above
    /// `white_above` white, all else gray.
    Vote,
  };
  std::vector<Point> places = {{kGroundSensorAhead_m, 0}};
  Reading reading = Reading::Color;
  int vote_ticks = 1;
  int vote_majority = 0;
  double black_below = 0;
  double white_above = 1;

  friend bool operator==(const GroundSensor&, const GroundSensor&) = default;
};

/// How a robot knows of others.
struct NeighbourSensor {
  enum class Source {
    Sight,  ///< the others' places, by a camera or a lidar as a profile says
    /// Packets, one from each robot and tick, that arrive or are lost (a profile's `miss_rate`).
    /// Those of the last `memory_ticks` cycles are known, where they came from then.
    Radio,
  };
  Source source = Source::Sight;
  double range_m = kNeighbourRange_m;  ///< others are nearer than this, centre to centre
  /// Of camera or antenna. What stands as high between two robots hides them from each other, be it
  /// a third one.
  double height_m = kCameraHeight_m;
  double less_m = 0;     ///< what a distance is less than that of the centres
  int memory_ticks = 1;  ///< of Radio, the present one included

  friend bool operator==(const NeighbourSensor&, const NeighbourSensor&) = default;
};

struct Robot {
  std::string name = "rvr";
  RobotBody body;
  RobotDrive drive;
  ProximityRing proximity;
  LightRing light;
  GroundSensor ground;
  NeighbourSensor neighbours;

  friend bool operator==(const Robot&, const Robot&) = default;
};

/// The robot of the thesis (rvr-automode facts, sections 2 and 3).
Robot rvr();

/// The same with a body of another outline.
Robot rvr_with(Outline outline);

}  // namespace swarmsmith
