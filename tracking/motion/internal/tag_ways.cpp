#include "tracking/motion/internal/tag_ways.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/assert.h"
#include "base/median.h"

namespace swarmsmith {
namespace {

/// With this, a run that is read from a store gives the same bits as the film.
double as_stored(double pixels) {
  return std::round(pixels * 1000) / 1000;
}

double edge_px(const TagCorners& corners) {
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const ImagePoint& next = corners.at((i + 1) % corners.size());
    sum += std::hypot(next.u - corners.at(i).u, next.v - corners.at(i).v);
  }
  return sum / static_cast<double>(corners.size());
}

void measure_scale(TagWay& tag, double edge_m) {
  std::vector<double> edges;
  for (const Sighting* const seen : tag.seen) {
    if (seen != nullptr) edges.push_back(edge_px(seen->corners));
  }
  // One scale for the whole picture: it is only used in limits of motion.
  tag.pixels_per_m = upper_median(std::move(edges)) / edge_m;
}

/// Sums the steps of a tag. A step is limited to the distance that the fastest robot can go since
/// the tag last moved, so that a tag that was misread or carried shows no speed.
void measure_way(TagWay& tag, const std::vector<double>& times) {
  constexpr double kStandingTag_px = 0.5;
  const Sighting* before = nullptr;
  std::size_t moved_at = 0;
  for (std::size_t frame = 0; frame < tag.seen.size(); ++frame) {
    tag.way[frame] = frame == 0 ? 0 : tag.way[frame - 1];
    const Sighting* const now = tag.seen[frame];
    if (now == nullptr) continue;
    if (before != nullptr) {
      const double step = corners_moved(before->corners, now->corners);
      // Since the tag last moved, not since the last frame: after copies of a picture a robot makes
      // up for all of the time in one step.
      const double most =
          tag.corner_speed_m_s * tag.pixels_per_m * (times[frame] - times[moved_at]);
      tag.way[frame] += std::min(step, most + kStandingTag_px);
      if (step > kStandingTag_px) moved_at = frame;
    } else {
      moved_at = frame;
    }
    before = now;
  }
}

/// The robots with only one tag each: the tag that the camera saw most often.
std::vector<RobotSetup> with_one_tag(const Observations& observations, int camera,
                                     std::span<const RobotSetup> robots) {
  std::vector<RobotSetup> made;
  for (const RobotSetup& robot : robots) {
    const std::vector<RobotSetup> tags = each_tag(robot);
    const auto times_seen = [&](const RobotSetup& tag) {
      return std::ranges::count_if(observations.sightings, [&](const Sighting& seen) {
        return seen.camera == camera && seen.tag == tag.tag;
      });
    };
    SWARMSMITH_ASSERT(!tags.empty(), "a robot carries a tag");
    const bool is_plain = tags.size() == 1;
    made.push_back(is_plain ? robot : *std::ranges::max_element(tags, {}, times_seen));
  }
  return made;
}

}  // namespace

double corners_moved(const TagCorners& from, const TagCorners& to) {
  double sum = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const double u = as_stored(to.at(i).u) - as_stored(from.at(i).u);
    const double v = as_stored(to.at(i).v) - as_stored(from.at(i).v);
    sum += u * u + v * v;
  }
  return std::sqrt(sum / static_cast<double>(from.size()));
}

std::vector<TagWay> tag_ways(const Observations& observations, int camera,
                             std::span<const RobotSetup> all_robots, double corner_speed_m_s) {
  const std::vector<RobotSetup> robots = with_one_tag(observations, camera, all_robots);
  const std::size_t frames =
      observations.cameras.at(static_cast<std::size_t>(camera)).frame_times.size();
  std::vector<TagWay> ways(robots.size());
  std::vector<std::vector<bool>> twice(robots.size(), std::vector<bool>(frames, false));
  for (TagWay& tag : ways) {
    tag.seen.assign(frames, nullptr);
    tag.way.assign(frames, 0);
    tag.corner_speed_m_s = corner_speed_m_s;
  }
  for (const Sighting& seen : observations.sightings) {
    // A damaged store may name a frame that does not exist.
    if (seen.camera != camera || seen.frame < 0 || static_cast<std::size_t>(seen.frame) >= frames) {
      continue;
    }
    const auto robot = std::ranges::find(robots, seen.tag, &RobotSetup::tag);
    if (robot == robots.end()) continue;
    const auto number = static_cast<std::size_t>(robot - robots.begin());
    const auto frame = static_cast<std::size_t>(seen.frame);
    // Which of the two is the robot is not known here, so the frame does not count.
    if (ways[number].seen[frame] != nullptr) twice[number][frame] = true;
    ways[number].seen[frame] = &seen;
  }
  std::vector<TagWay> kept;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    for (std::size_t frame = 0; frame < frames; ++frame) {
      if (twice[i][frame]) ways[i].seen[frame] = nullptr;
    }
    const bool is_seen = std::ranges::any_of(ways[i].seen, [](const Sighting* s) { return s; });
    if (!is_seen) continue;
    measure_scale(ways[i], robots[i].edge_m);
    measure_way(ways[i], observations.cameras[static_cast<std::size_t>(camera)].frame_times);
    kept.push_back(std::move(ways[i]));
  }
  return kept;
}

std::size_t frame_before(const std::vector<double>& times, std::size_t frame, double span_s) {
  SWARMSMITH_ASSERT(frame < times.size(), "a frame has its time");
  const auto first = std::ranges::lower_bound(times, times[frame] - span_s);
  return std::min(static_cast<std::size_t>(first - times.begin()), frame);
}

std::size_t frame_after(const std::vector<double>& times, std::size_t frame, double span_s) {
  SWARMSMITH_ASSERT(frame < times.size(), "a frame has its time");
  const auto last = std::ranges::upper_bound(times, times[frame] + span_s);
  return std::max(static_cast<std::size_t>(last - times.begin()), frame + 1) - 1;
}

}  // namespace swarmsmith
