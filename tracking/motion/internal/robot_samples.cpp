#include "tracking/motion/internal/robot_samples.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "base/assert.h"
#include "base/math.h"
#include "base/median.h"
#include "tracking/geometry/walls.h"
#include "tracking/motion/internal/outliers.h"

namespace swarmsmith {
namespace {

/// Rounds corners as stores do, so that a stored run gives exactly the same score again.
TagCorners as_stored(TagCorners corners) {
  for (ImagePoint& corner : corners) {
    corner.u = std::round(corner.u * 1000) / 1000;
    corner.v = std::round(corner.v * 1000) / 1000;
  }
  return corners;
}

bool is_finite(const TagPose& tag) {
  return std::isfinite(tag.pose.x) && std::isfinite(tag.pose.y) && std::isfinite(tag.pose.theta) &&
         std::isfinite(tag.scale) && std::isfinite(tag.residual_m);
}

Sample sample_of(const Sighting& seen, const TaggedRobot& robot, const TrackedCamera& camera,
                 const TrackOptions& options) {
  Sample sample{.time_s = seen.time_s - camera.start_s, .camera = seen.camera, .frame = seen.frame};
  const double height = options.corrects_height ? robot.setup.height_m : 0;
  const TagPose tag = tag_pose(camera.view, as_stored(seen.corners), robot.setup.edge_m, height);
  if (!is_finite(tag)) {
    sample.scale = 0;
    sample.use = Sample::Use::BadFit;
    return sample;
  }
  sample.pose = robot_pose(tag.pose, robot.offset);
  sample.scale = tag.scale;
  sample.residual_m = tag.residual_m;
  return sample;
}

/// Like the tag's residual, but against the best similarity: a wrong edge or height is not a bad
/// fit, and must not drop all samples. The squares of a rigid fit are the squares of the similarity
/// fit plus the squares due to its scale.
double residual_of_shape(const Sample& sample, double edge_m) {
  // The corners of a square are edge / sqrt(2) from its middle, so a scale moves each by this.
  const double of_scale = 0.5 * edge_m * edge_m * (1 - sample.scale) * (1 - sample.scale);
  return std::sqrt(std::max(0.0, sample.residual_m * sample.residual_m - of_scale));
}

double median_scale(const std::vector<Sample>& samples) {
  std::vector<double> scales;
  for (const Sample& sample : samples) {
    if (sample.use == Sample::Use::Used) scales.push_back(sample.scale);
  }
  return scales.empty() ? 1 : upper_median(std::move(scales));
}

/// Drops single bad fits; returns the mean scale of the other samples.
double drop_bad_fits(std::vector<Sample>& samples, double edge_m, const TrackLimits& limits) {
  // Relative to the robot's own scale. Whether that scale is right is decided later, by
  // `judge_tags`.
  const double usual = median_scale(samples);
  double sum = 0;
  int count = 0;
  for (Sample& sample : samples) {
    if (sample.use != Sample::Use::Used) continue;
    if (std::fabs(sample.scale - usual) > limits.scale_scatter ||
        residual_of_shape(sample, edge_m) > limits.residual_m) {
      sample.use = Sample::Use::BadFit;
      continue;
    }
    sum += sample.scale;
    ++count;
  }
  return count == 0 ? usual : sum / count;
}

TimedPose timed(const Sample& sample) {
  return {sample.time_s, sample.pose};
}

/// The samples of one frame that were not dropped yet.
struct FrameGroup {
  std::vector<Sample*> samples;
};

std::vector<FrameGroup> frames_of(std::vector<Sample>& samples, int camera) {
  std::vector<FrameGroup> frames;
  for (Sample& sample : samples) {
    if (sample.camera != camera || sample.use != Sample::Use::Used) continue;
    SWARMSMITH_ASSERT(frames.empty() || frames.back().samples.front()->frame <= sample.frame,
                      "samples of a camera come in the order of its frames");
    if (frames.empty() || frames.back().samples.front()->frame != sample.frame) {
      frames.emplace_back();
    }
    frames.back().samples.push_back(&sample);
  }
  return frames;
}

/// Frames with the tag at two places, even if a sighting was dropped: a duplicate tag on the floor
/// is a bad fit, but it still disturbs.
std::vector<std::int64_t> frames_with_twins(const std::vector<Sample>& samples) {
  std::vector<std::int64_t> frames;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const bool is_twin =
        samples[i].camera == samples[i - 1].camera && samples[i].frame == samples[i - 1].frame;
    if (is_twin && (frames.empty() || frames.back() != samples[i].frame)) {
      frames.push_back(samples[i].frame);
    }
  }
  return frames;
}

/// The sample of a frame that fits the track, or none.
Sample* consistent_one(const FrameGroup& frame, const Sample* before, const Sample* after,
                       const TrackLimits& limits) {
  if (before == nullptr && after == nullptr) return nullptr;
  Sample* found = nullptr;
  for (Sample* sample : frame.samples) {
    // Tracking facts, section 8, "Identity": the sighting that fits the track is used; if both or
    // neither fit, both are dropped.
    if (before != nullptr && !is_reachable(timed(*before), timed(*sample), limits)) continue;
    if (after != nullptr && !is_reachable(timed(*sample), timed(*after), limits)) continue;
    if (found != nullptr) return nullptr;
    found = sample;
  }
  return found;
}

void resolve_duplicates(RobotSamples& robot, int camera, const TrackLimits& limits) {
  const std::vector<FrameGroup> frames = frames_of(robot.samples, camera);
  // The next frame with one sighting only: the next frame with two has not been decided yet.
  std::vector<const Sample*> next_alone(frames.size() + 1, nullptr);
  for (std::size_t i = frames.size(); i > 0; --i) {
    const auto& samples = frames[i - 1].samples;
    next_alone[i - 1] = samples.size() == 1 ? samples.front() : next_alone[i];
  }
  const Sample* before = nullptr;
  // A sample that is farther away in time says little about where the robot is.
  const auto is_near = [&](const Sample* a, const Sample* b) {
    return a != nullptr && std::fabs(a->time_s - b->time_s) <= limits.degraded_gap_s;
  };
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto& samples = frames[i].samples;
    Sample* used = samples.front();
    if (samples.size() > 1) {
      const Sample* after = next_alone[i];
      used = consistent_one(frames[i], is_near(before, used) ? before : nullptr,
                            is_near(after, used) ? after : nullptr, limits);
      if (used == nullptr) ++robot.twice_unresolved;
      for (Sample* sample : samples) {
        if (sample != used) sample->use = Sample::Use::Duplicate;
      }
    }
    SWARMSMITH_ASSERT(used == nullptr || used->use == Sample::Use::Used, "it stays in use");
    if (used != nullptr) before = used;
  }
}

void drop_outliers(std::vector<Sample>& samples, int camera, const TrackLimits& limits) {
  std::vector<Sample*> used;
  std::vector<TimedPose> track;
  for (Sample& sample : samples) {
    if (sample.camera != camera || sample.use != Sample::Use::Used) continue;
    used.push_back(&sample);
    track.push_back(timed(sample));
  }
  const std::vector<bool> believed = believable(track, limits);
  SWARMSMITH_ASSERT(believed.size() == used.size(), "a word about each sample");
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (!believed[i]) used[i]->use = Sample::Use::Outlier;
  }
}

/// An order of sightings that does not depend on the order in which they arrived.
bool comes_first(const Sighting& a, const Sighting& b) {
  const auto key = [](const Sighting& s) {
    return std::tuple(s.camera, s.frame, s.time_s, s.corners[0].u, s.corners[0].v, s.corners[2].u,
                      s.corners[2].v, s.corners[1].u, s.corners[1].v, s.corners[3].u,
                      s.corners[3].v);
  };
  return key(a) < key(b);
}

}  // namespace

RobotSamples samples_of(const TaggedRobot& robot, const std::vector<Sighting>& sightings,
                        std::vector<std::size_t> own, std::span<const TrackedCamera> cameras,
                        const Arena& arena, const TrackOptions& options) {
  const TrackLimits& limits = options.limits;
  RobotSamples made;
  // The store may return sightings in another order, and a later scoring must give the same bits.
  std::ranges::sort(
      own, [&](std::size_t a, std::size_t b) { return comes_first(sightings[a], sightings[b]); });
  for (const std::size_t number : own) {
    SWARMSMITH_ASSERT(number < sightings.size(), "a sighting has its number");
    const Sighting& seen = sightings[number];
    SWARMSMITH_ASSERT(static_cast<std::size_t>(seen.camera) < cameras.size(),
                      "sightings of cameras that are lost were left out");
    made.samples.push_back(
        sample_of(seen, robot, cameras[static_cast<std::size_t>(seen.camera)], options));
    made.samples.back().sighting = number;
  }
  // Counted before anything is dropped.
  made.twice = frames_with_twins(made.samples);
  made.scale = drop_bad_fits(made.samples, robot.setup.edge_m, limits);
  for (Sample& sample : made.samples) {
    if (sample.use != Sample::Use::Used) continue;
    const Point at = sample.pose.position();
    // Tracking facts, section 8. Less than this beyond a wall may be an error of survey or height.
    if (!is_inside(arena, at) && distance_to_walls(arena, at) > limits.outside_m) {
      sample.use = Sample::Use::Outside;
    }
  }
  // For each camera alone: positions from two cameras differ by their calibrations, which is not
  // motion. Duplicates come first, because the next step expects one place per frame.
  for (int camera = 0; camera < static_cast<int>(cameras.size()); ++camera) {
    resolve_duplicates(made, camera, limits);
    drop_outliers(made.samples, camera, limits);
  }
  // The samples of each camera are already in order, so this keeps frames together.
  std::ranges::stable_sort(made.samples, {}, &Sample::time_s);
  return made;
}

}  // namespace swarmsmith
