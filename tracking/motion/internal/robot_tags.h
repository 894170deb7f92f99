#pragma once

#include <span>
#include <string>
#include <vector>

#include "tracking/motion/internal/robot_samples.h"

namespace swarmsmith {

/// One tag of a robot that carries several, and what was made of its sightings.
struct OneOfTags {
  TaggedRobot tag;
  RobotSamples samples;
};

/// Samples of a robot with several tags: one a picture, from all of its tags that were seen there
/// and fit, weighted by the inverse squares of their sigmas. With one tag alone in a picture, that
/// tag's sample to the bit.
RobotSamples fused_samples(std::span<const OneOfTags> tags, std::span<const TrackedCamera> cameras,
                           const Rig& rig);

/// Asks whether the tags are where the robot's calibration has them to each other, in every second
/// of the run in which two are seen together (E_TAGS_DISAGREE); where a tag was never seen together
/// with another one, nothing can tell (W_TAG_PLACE). A tag that was never seen is said
/// (W_FILM_ODD).
void judge_agreement(std::span<const OneOfTags> tags, std::span<const TrackedCamera> cameras,
                     const Rig& rig, TrackedRun& run);

}  // namespace swarmsmith
