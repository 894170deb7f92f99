#pragma once

#include <optional>

#include "sim/robot/robot.h"

namespace swarmsmith {

/// The RVR's constants that a robot of another shape keeps.
struct KeptConstants {
  double mass_kg = 0;
  double drive_N = 0;
  double treads_m = 0;         ///< distance between the treads
  double ground_sensor_m = 0;  ///< ahead of the centre
  double height_m = 0;
  double neighbours_m = 0;  ///< range at which they are seen
};

/// Nothing for the RVR's own body, and for robots that differ from it in more than the outline.
std::optional<KeptConstants> kept_constants(const Robot& robot);

}  // namespace swarmsmith
