#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tracking/motion/internal/robot_samples.h"
#include "tracking/observing/observations.h"

namespace swarmsmith {

/// How a tag leans out of the plane that its robot's file gives it: the upward slope of its plane,
/// in the axes of the measured tag.
struct TagTilt {
  double along = 0;  ///< its x axis
  double aside = 0;  ///< its y axis
  double sigma = 0;  ///< of each

  double angle_rad() const;
};

/// From the shapes of a tag at several places: a plane that leans shears the picture of the tag,
/// the more, the further it is from the point below the camera. Nothing
/// when they are all near that point.
std::optional<TagTilt> tilt_of(const RobotSetup& robot, std::span<const Sample> samples,
                               const std::vector<Sighting>& sightings,
                               std::span<const TrackedCamera> cameras);

/// What its pictures say of a robot's tag, where that is more than is known of it beforehand.
struct TagEvidence {
  double height_off_m = 0;  ///< that its height may be wrong by
  double tilt_rad = 0;      ///< that it leans
};

/// One tag of one robot, and what was seen of it.
struct TrackedTag {
  const TaggedRobot* tag = nullptr;
  std::size_t robot = 0;  ///< its number in the run
  std::span<const Sample> samples;
  double mean_scale = 1;
};

/// Asks of each tag whether it has the size that its height makes of it (E_TAG_SIZE,
/// W_TAG_SIZE) and lies level (W_TILTED).
std::vector<TagEvidence> judge_tags(const std::vector<TrackedTag>& tags,
                                    const Observations& observations,
                                    std::span<const TrackedCamera> cameras, const Rig& rig,
                                    const TrackLimits& limits, TrackedRun& run);

/// The same for a robot that cannot be tracked: a clause for its error, or nothing.
std::string tilt_clause(const RobotSetup& robot, std::span<const Sample> samples,
                        const std::vector<Sighting>& sightings,
                        std::span<const TrackedCamera> cameras);

}  // namespace swarmsmith
