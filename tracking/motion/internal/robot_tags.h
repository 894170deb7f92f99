#pragma once

#include <span>
#include <string>
#include <vector>

#include "tracking/motion/internal/robot_samples.h"

namespace swarmsmith {

/// One tag of a robot that has several, and the samples from its sightings.
struct OneOfTags {
  TaggedRobot tag;
  RobotSamples samples;
};

/// Samples of a robot with several tags: one sample per picture, from all tags that were seen in it
/// and fit, weighted by the inverse squares of their sigmas. If only one tag was seen, its sample
/// is used unchanged.
RobotSamples fused_samples(std::span<const OneOfTags> tags, std::span<const TrackedCamera> cameras,
                           const Rig& rig);

/// Checks, for each stretch of pictures in which two tags are seen together, whether their relative
/// position agrees with the robot's calibration (E_TAGS_DISAGREE). A tag that was never seen
/// together with another one cannot be checked (W_TAG_PLACE). A tag that was never seen is reported
/// (W_FILM_ODD). `driving_m_s`: how fast a robot moves while a rolling shutter reads the rows
/// between its tags.
void judge_agreement(std::span<const OneOfTags> tags, std::span<const TrackedCamera> cameras,
                     const Rig& rig, double driving_m_s, TrackedRun& run);

}  // namespace swarmsmith
