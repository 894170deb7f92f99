#pragma once

#include <span>
#include <string>
#include <vector>

#include "tracking/geometry/view.h"
#include "tracking/motion/track_run.h"

namespace swarmsmith {

/// A camera of the observations, with the data that converts its pixels to metres.
struct TrackedCamera {
  std::string name;
  View view;
  double start_s = 0;         ///< start of the run on the camera's clock
  double place_error_m = 0;   ///< one sigma on the floor, from the calibration of its place
  double lens_error_rad = 0;  ///< one sigma of a ray, from its lens calibration
  double time_error_s = 0;    ///< one sigma of its time stamps
};

/// A robot with one of its tags.
struct TaggedRobot {
  RobotSetup setup;
  TagOffset offset;
  double offset_sigma_m = 0;  ///< per axis, from the calibration; 0 without one
  bool has_offset = false;
  bool has_yaw = false;     ///< the heading is known from a straight run
  bool is_another = false;  ///< not the first tag of its robot

  /// The subject of checks of the tag.
  std::string subject() const {
    return is_another ? setup.name + " tag " + std::to_string(setup.tag) : setup.name;
  }
};

/// The samples from a robot's sightings.
struct RobotSamples {
  std::vector<Sample> samples;      ///< sorted by time, camera, frame
  std::vector<std::int64_t> twice;  ///< frames in which its tag was seen twice or more
  int twice_unresolved = 0;         ///< number of these frames from which no sample was used
  double scale = 1;                 ///< mean scale of the samples that fit
};

/// Poses of a robot from the sightings of its tag. A sample is used if it fits, lies inside the
/// arena, is the only one of its frame, and can be reached from the sample before it. `own` are the
/// indices of the robot's sightings during the run and shortly before and after it, in any order.
RobotSamples samples_of(const TaggedRobot& robot, const std::vector<Sighting>& sightings,
                        std::vector<std::size_t> own, std::span<const TrackedCamera> cameras,
                        const Arena& arena, const TrackOptions& options);

}  // namespace swarmsmith
