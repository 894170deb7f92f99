#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tracking/motion/internal/robot_samples.h"
#include "tracking/observing/observations.h"

namespace swarmsmith {

/// How much a tag leans against the plane that its robot's file gives: the upward slope of the
/// tag's plane, in the axes of the measured tag.
struct TagTilt {
  double along = 0;  ///< slope along its x axis
  double aside = 0;  ///< slope along its y axis
  double sigma = 0;  ///< one sigma of each

  double angle_rad() const;
};

/// Computes the tilt from the shape of a tag at several places: the picture of a tag that leans is
/// sheared, and more so the farther the tag is from the point below the camera. Nothing if all
/// places are near that point.
std::optional<TagTilt> tilt_of(const RobotSetup& robot, std::span<const Sample> samples,
                               const std::vector<Sighting>& sightings,
                               std::span<const TrackedCamera> cameras);

/// Errors of a robot's tag that the pictures show, if they exceed the errors that are assumed.
struct TagEvidence {
  double height_off_m = 0;  ///< possible error of its height
  double tilt_rad = 0;      ///< angle between the tag and the floor
};

/// One tag of a robot, and its sightings.
struct TrackedTag {
  const TaggedRobot* tag = nullptr;
  std::size_t robot = 0;  ///< its index in the run
  std::span<const Sample> samples;
  double mean_scale = 1;
};

/// Checks for each tag whether its size agrees with its height (E_TAG_SIZE, W_TAG_SIZE) and whether
/// it is level (W_TILTED).
std::vector<TagEvidence> judge_tags(const std::vector<TrackedTag>& tags,
                                    const Observations& observations,
                                    std::span<const TrackedCamera> cameras, const Rig& rig,
                                    const TrackLimits& limits, TrackedRun& run);

/// The same for a robot that cannot be tracked: text to add to its error, or nothing.
std::string tilt_clause(const RobotSetup& robot, std::span<const Sample> samples,
                        const std::vector<Sighting>& sightings,
                        std::span<const TrackedCamera> cameras);

}  // namespace swarmsmith
