#pragma once

namespace swarmsmith {

/// Compile-time constants of the RVR's body, drive and sensors, for code that is optimised for the
/// RVR. `rvr()` of robot.h gives the same values. SI units.

/// Side of its square body, and its height (argos3-rvr; rvr-automode facts, section 2).
inline constexpr double kBodySide_m = 0.286;
inline constexpr double kBodyHeight_m = 0.114;
inline constexpr double kMass_kg = 2.0;
/// The drive tracks its set-point with at most this force and torque.
inline constexpr double kMaxForce_N = 1.5;
inline constexpr double kMaxTorque_Nm = 1.5;
/// Friction of a contact with another robot or a wall; restitution is 0.
inline constexpr double kFriction = 0.49;

/// The eight proximity rays start on the circle inscribed in the body (rvr-automode facts, section
/// 3.1).
inline constexpr double kRayStart_m = 0.143;
/// Heights of the proximity and lidar rays above the floor; they pass over lower obstacles and
/// objects (rvr-automode facts, sections 3.1 and 3.4).
inline constexpr double kProximityHeight_m = 0.032;
inline constexpr double kLidarHeight_m = 0.04;
/// All light sensors lie on this circle around the robot's axis, at this height (thesis facts,
/// sections 3 and 6.1).
inline constexpr double kLightSensorsOut_m = 0.143;
inline constexpr double kLightSensorsHeight_m = 0.114;
/// Height of its camera and of its lidar's turret, above all other parts (thesis facts, section 3).
inline constexpr double kCameraHeight_m = 0.154;
/// Position of the ground sensor, ahead of the centre (rvr-automode facts, section 3.2).
inline constexpr double kGroundSensorAhead_m = 0.05;

}  // namespace swarmsmith
