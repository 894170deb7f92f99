#pragma once

#include <span>
#include <string>
#include <vector>

#include "tracking/geometry/view.h"
#include "tracking/motion/track_run.h"

namespace swarmsmith {

/// A camera of the observations with all that turns its pixels into metres.
struct TrackedCamera {
  std::string name;
  View view;
  double start_s = 0;         ///< of the run, on the camera's clock
  double place_error_m = 0;   ///< on the floor, one sigma, from its calibration
  double lens_error_rad = 0;  ///< of a ray, one sigma, from its lens calibration
  double time_error_s = 0;    ///< of its stamps, one sigma
};

/// A robot with what is known of its tag.
struct TaggedRobot {
  RobotSetup setup;
  TagOffset offset;
  double offset_sigma_m = 0;  ///< of one axis, from its calibration; 0 without one
  bool has_offset = false;
  bool has_yaw = false;     ///< a straight run told the heading
  bool is_another = false;  ///< not the first tag of its robot

  /// What checks of the tag are about.
  std::string subject() const {
    return is_another ? setup.name + " tag " + std::to_string(setup.tag) : setup.name;
  }
};

/// What was made of a robot's sightings.
struct RobotSamples {
  std::vector<Sample> samples;      ///< by time, camera, frame
  std::vector<std::int64_t> twice;  ///< frames with its tag seen twice or more
  int twice_unresolved = 0;         ///< of those, frames from which none was used
  double scale = 1;                 ///< mean over what fits
};

/// Poses of a robot from the sightings of its tag, each with its use: fits, inside of the arena,
/// only one a frame, reachable from the one before. `own` are the numbers of the robot's
/// sightings within the run and a little before and after it, in any order.
RobotSamples samples_of(const TaggedRobot& robot, const std::vector<Sighting>& sightings,
                        std::vector<std::size_t> own, std::span<const TrackedCamera> cameras,
                        const Arena& arena, const TrackOptions& options);

}  // namespace swarmsmith
