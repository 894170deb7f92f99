#pragma once

namespace swarmsmith {

/// The RVR's table: numbers of its body, drive and sensors at compile time, for the ways that are
/// quicker than the general ones. `rvr()` of robot.h has the same as a value. SI units.

/// Side of its square body, and its height (argos3-rvr; rvr-automode facts, section 2).
inline constexpr double kBodySide_m = 0.286;
inline constexpr double kBodyHeight_m = 0.114;
inline constexpr double kMass_kg = 2.0;
/// The drive tracks its set-point with at most this force and torque.
inline constexpr double kMaxForce_N = 1.5;
inline constexpr double kMaxTorque_Nm = 1.5;
/// Of a contact, with another robot or a wall; restitution is 0.
inline constexpr double kFriction = 0.49;

/// The eight proximity rays start on the circle that is inscribed in the body (rvr-automode facts,
/// section 3.1).
inline constexpr double kRayStart_m = 0.143;
/// Where proximity and lidar rays run above the floor; they pass over obstacles and objects that
/// are lower (rvr-automode facts, sections 3.1 and 3.4).
inline constexpr double kProximityHeight_m = 0.032;
inline constexpr double kLidarHeight_m = 0.04;
/// All light sensors lie on this circle around the robot's axis, at this height (thesis facts,
/// sections 3 and 6.1).
inline constexpr double kLightSensorsOut_m = 0.143;
inline constexpr double kLightSensorsHeight_m = 0.114;
/// Of its camera and its lidar's turret, above all else (thesis facts, section 3).
inline constexpr double kCameraHeight_m = 0.154;
/// The place of the ground sensor, ahead of the centre (rvr-automode facts, section 3.2).
inline constexpr double kGroundSensorAhead_m = 0.05;

}  // namespace swarmsmith
