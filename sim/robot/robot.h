#pragma once

#include <array>
#include <string>
#include <vector>

#include "sim/control/reference_model.h"
#include "sim/control/treads.h"
#include "sim/robot/outline.h"
#include "sim/robot/rvr.h"

namespace swarmsmith {

/// A robot as data: one struct per device, plain values. The errors of a device are data of a
/// profile (sim/engine/profile.h); how control software interprets readings is data of a flavour.
/// SI units; the robot's frame has x forward and y left. The defaults are the RVR's values.

/// A rigid body on the floor.
struct RobotBody {
  Outline outline = BoxOutline{kBodySide_m, kBodySide_m};
  double height_m = kBodyHeight_m;
  double mass_kg = kMass_kg;
  double inertia_kg_m2 = 0;  ///< about the vertical axis; 0: computed for a plate with its outline
  /// Friction coefficients of contacts; restitution is 0.
  double robot_friction = kFriction;  ///< with another robot
  double wall_friction = kFriction;   ///< with a wall or any other body

  friend bool operator==(const RobotBody&, const RobotBody&) = default;
};

/// Two wheels or treads on one axis through the centre.
struct RobotDrive {
  double track_m = kTreadDistance_m;  ///< distance between the wheels or treads
  double max_speed_mps = kMaxWheelSpeed_mps;
  /// Limits of the whole drive, which accelerates towards the commanded speed and spin.
  double max_force_N = kMaxForce_N;
  double max_torque_Nm = kMaxTorque_Nm;

  friend bool operator==(const RobotDrive&, const RobotDrive&) = default;
};

/// Angles from the robot's head, degrees, counter-clockwise, by index; up to kMostRingSensors.
using RingAngles = std::vector<double>;

/// Rays around the robot; they begin on a circle around its centre.
struct ProximityRing {
  /// The reading of a sensor for the distance to the first hit of its ray.
  enum class Reading {
    Distance,  ///< the distance itself, up to the range given by a profile
    /// a + b d + c d^2 within [0, 1], and 0 beyond `reach_m`. A ray that starts inside a body, or
    /// behind the face of a wall, does not hit it.
    Strength,
  };
  RingAngles rays_deg = rvr_ring();
  RingAngles labels_deg;  ///< directions assumed by control software; empty: the true ones
  double start_m = 0;     ///< the circle's radius; 0: the circle inscribed in the body
  double height_m = kProximityHeight_m;
  Reading reading = Reading::Distance;
  /// For Strength.
  double reach_m = 0;
  std::array<double, 3> law = {0, 0, 0};  ///< a, b (1/m) and c (1/m^2)

  static RingAngles rvr_ring();
  friend bool operator==(const ProximityRing&, const ProximityRing&) = default;
};

/// Light sensors around the robot.
struct LightRing {
  enum class Reading {
    /// I / d^2 at the sensor's place, times the cosine of the horizontal angle to the light.
    Lux,
    /// exp(-2 rho) (1 - 2 angle / pi), rho = d / I up to 2.5, within [0, 1]
    Strength,
  };
  RingAngles angles_deg;              ///< empty: the same as the proximity rays
  double out_m = kLightSensorsOut_m;  ///< distance from the robot's axis at which light is measured
  double height_m = kLightSensorsHeight_m;
  Reading reading = Reading::Lux;

  friend bool operator==(const LightRing&, const LightRing&) = default;
};

/// The sensor for the colour of the floor.
struct GroundSensor {
  enum class Reading {
    Color,  ///< RGB under the only point
    /// Black, gray or white: the grey levels in [0, 1] of all points in the last `vote_ticks`
    /// control cycles are counted. The result is black if more than `vote_majority` are below
    /// `black_below`, white if more than that are above `white_above`, otherwise gray.
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

/// How a robot detects others.
struct NeighbourSensor {
  enum class Source {
    Sight,  ///< the positions of the others, from a camera or a lidar, depending on the profile
    /// Packets, one from each robot per tick, that arrive or are lost (the profile's `miss_rate`).
    /// A robot knows the packets of the last `memory_ticks` cycles, with the direction and distance
    /// from which each came.
    Radio,
  };
  Source source = Source::Sight;
  double range_m = kNeighbourRange_m;  ///< other robots are detected when nearer than this, centre
                                       ///< to centre
  /// Height of the camera or antenna. Anything as high between two robots hides them from each
  /// other, a third robot included.
  double height_m = kCameraHeight_m;
  double less_m = 0;     ///< subtracted from the distance between the centres
  int memory_ticks = 1;  ///< for Radio, the present one included

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

/// The same robot with a body of another outline.
Robot rvr_with(Outline outline);

/// Whether it is the RVR, with any outline.
bool is_rvr(const Robot& robot);

}  // namespace swarmsmith
