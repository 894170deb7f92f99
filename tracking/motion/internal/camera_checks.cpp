#include "tracking/motion/internal/camera_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/assert.h"
#include "base/median.h"
#include "tracking/motion/internal/camera_moved.h"
#include "tracking/motion/internal/clock_checks.h"
#include "tracking/motion/resampling.h"

namespace swarmsmith {
namespace {

constexpr Question kCoverage{"film covers the run", "s", "a start or an end that no camera filmed"};
constexpr Question kRate{"frame rate", "frames/s", "turns and gaps between two frames"};
constexpr Question kDropped{"dropped frames", "%", "a recorder that cannot keep up"};

double duration_of(const TrackOptions& options) {
  return instant_s(options.span.cycles);
}

/// One camera's frames on the clock of the run.
struct FramesOfRun {
  std::vector<double> times;      ///< times of all frames that are not repeats
  std::vector<double> intervals;  ///< between these frames, during the run
  std::int64_t within = 0;
  double usual_s = 0;  ///< median of the intervals; 0 without one
};

FramesOfRun frames_of(const CameraRecord& record, const Repeats& repeats, double start_s,
                      double duration_s) {
  SWARMSMITH_ASSERT(repeats.again.size() == record.frame_times.size(), "a word about each frame");
  FramesOfRun frames;
  for (std::size_t i = 0; i < record.frame_times.size(); ++i) {
    // A copy does not count as a picture, so a recorder cannot hide a low rate with
    // copies.
    if (!repeats.again[i]) frames.times.push_back(record.frame_times[i] - start_s);
  }
  const auto is_within = [&](double t) {
    return t >= -kSameInstant_s && t <= duration_s + kSameInstant_s;
  };
  for (std::size_t i = 0; i < frames.times.size(); ++i) {
    if (!is_within(frames.times[i])) continue;
    ++frames.within;
    if (i > 0 && is_within(frames.times[i - 1])) {
      frames.intervals.push_back(frames.times[i] - frames.times[i - 1]);
    }
  }
  if (!frames.intervals.empty()) frames.usual_s = upper_median(frames.intervals);
  return frames;
}

/// Number of missing frames, estimated with the usual interval.
std::int64_t dropped_in(const FramesOfRun& frames) {
  std::int64_t dropped = 0;
  for (const double interval : frames.intervals) {
    // Between one interval and two: shorter ones are jitter of the clock.
    if (interval > 1.5 * frames.usual_s) {
      dropped += static_cast<std::int64_t>(std::llround(interval / frames.usual_s)) - 1;
    }
  }
  return dropped;
}

void check_rate(const FramesOfRun& frames, std::int64_t dropped, const std::string& camera,
                const TrackLimits& limits, FrameReport& report) {
  std::vector<Issue>& issues = report.issues;
  const std::size_t first = issues.size();
  // Clocks round to milliseconds, so 10 frames/s may appear as 9.99.
  constexpr double kRounding = 0.99;
  // Tracking facts, section 7: 10 frames/s are the least.
  if (frames.usual_s > 0 && 1 / frames.usual_s < kRounding * limits.least_frame_rate) {
    issues.push_back({IssueCode::FrameRate,
                      fmt::format("camera {} took {:.1f} frames/s, at least {:.0f} are needed; "
                                  "film at 15 to 30 frames/s",
                                  camera, 1 / frames.usual_s, limits.least_frame_rate)});
  }
  const auto all = static_cast<double>(frames.within + dropped);
  // 5 % (tracking facts, section 10).
  if (all > 0 && static_cast<double>(dropped) > limits.dropped_share * all) {
    issues.push_back({IssueCode::FramesDropped,
                      fmt::format("camera {} dropped {} of {:.0f} frames ({:.1f} %, limit {:.0f} "
                                  "%); a faster disk or a lower frame rate helps",
                                  camera, dropped, all, 100 * static_cast<double>(dropped) / all,
                                  100 * limits.dropped_share)});
  }
  if (frames.usual_s > 0) {
    report.checks.push_back(answered(kRate, camera, outcome_of(issues, first, IssueCode::FrameRate),
                                     1 / frames.usual_s, limits.least_frame_rate));
  }
  if (all > 0) {
    report.checks.push_back(
        answered(kDropped, camera, outcome_of(issues, first, IssueCode::FramesDropped),
                 100 * static_cast<double>(dropped) / all, 100 * limits.dropped_share));
  }
}

/// Why the film covers less than the run.
std::string short_of(const Observations& observations, std::span<const Repeats> repeats) {
  for (std::size_t c = 0; c < repeats.size(); ++c) {
    const std::vector<double>& times = observations.cameras[c].frame_times;
    if (observations.cameras[c].damaged_frames > 0 && !times.empty() && !repeats[c].again.back())
      return fmt::format("{} of the file's pictures are damaged; copy it again from the camera",
                         observations.cameras[c].damaged_frames);
    if (!times.empty() && repeats[c].again.back())
      return "its recorder hung, and wrote the last picture over and over";
  }
  const bool is_cut = std::ranges::any_of(observations.issues, [](const Issue& issue) {
    return issue.code == IssueCode::VideoTruncated;
  });
  if (is_cut) return "the file is damaged or cut off; copy it again from the camera";
  return "let the camera run from before the start until after the end";
}

void check_coverage(FrameReport& report, double slack_s, const std::string& why,
                    const TrackOptions& options) {
  const double duration = duration_of(options);
  // The state at the end is never extrapolated (tracking facts, section 7): a mission that is
  // scored at its last instant needs a picture there.
  const double slack_at_end = options.scored_at_the_end ? kSameInstant_s : slack_s;
  if (report.from_s <= slack_s && report.to_s >= duration - slack_at_end &&
      report.covered_s >= duration - 2 * slack_s) {
    return;
  }
  report.issues.push_back({IssueCode::VideoTruncated,
                           fmt::format("covered {:.2f} of {:.0f} s (from {:.2f} s to {:.2f} s): {}",
                                       report.covered_s, duration, report.from_s, report.to_s, why),
                           {},
                           report.from_s,
                           report.to_s});
}

/// The union of the cameras' periods, each from the first to the last frame.
void measure_coverage(FrameReport& report, std::vector<std::pair<double, double>> spans,
                      double duration_s) {
  std::ranges::sort(spans);
  double end = 0;
  for (std::size_t i = 0; i < spans.size(); ++i) {
    // From the end of the earlier cameras on: what two cameras film at the same time counts once.
    const double from = std::clamp(spans[i].first, end, duration_s);
    const double to = std::clamp(spans[i].second, end, duration_s);
    if (i == 0) report.from_s = from;
    report.covered_s += to - from;
    end = std::max(end, to);
    SWARMSMITH_ASSERT(end <= duration_s, "what is covered is part of the run");
    if (spans[i].second >= duration_s - kSameInstant_s) report.covers_the_end = true;
  }
  report.to_s = std::max(report.from_s, end);
}

}  // namespace

FrameReport frame_report(const Observations& observations, std::span<const TrackedCamera> cameras,
                         std::span<const Repeats> repeats, const Rig& rig,
                         const TrackOptions& options) {
  SWARMSMITH_ASSERT(
      repeats.size() == cameras.size() && observations.cameras.size() == cameras.size(),
      "each camera has its record, and a word about its frames");
  FrameReport report;
  Findings of_clocks;
  const double duration = duration_of(options);
  std::vector<double> intervals;
  std::vector<std::pair<double, double>> spans;
  double slack = 0;
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    const CameraRecord& record = observations.cameras[c];
    const FramesOfRun frames = frames_of(record, repeats[c], cameras[c].start_s, duration);
    report.times.insert(report.times.end(), frames.times.begin(), frames.times.end());
    if (!frames.times.empty()) spans.emplace_back(frames.times.front(), frames.times.back());
    intervals.insert(intervals.end(), frames.intervals.begin(), frames.intervals.end());
    const std::int64_t dropped = dropped_in(frames);
    report.frames += frames.within;
    report.dropped += dropped;
    report.twice += static_cast<std::int64_t>(repeats[c].count);
    // A film that begins and ends with the run may have its first and last picture up to an
    // interval inside it.
    slack = std::max(slack, 1.5 * frames.usual_s);
    check_rate(frames, dropped, cameras[c].name, options.limits, report);
    check_clock(
        {record, cameras[c], repeats[c],
         tag_ways(observations, static_cast<int>(c), rig.robots, options.limits.corner_speed_m_s),
         options.span.lengths_s.empty() ? std::nullopt : options.span.lengths_s[c], duration},
        of_clocks);
    check_camera(record, cameras[c], rig, options, report.issues, report.checks);
  }
  report.issues.insert(report.issues.begin(), of_clocks.issues.begin(), of_clocks.issues.end());
  report.checks.insert(report.checks.end(), of_clocks.checks.begin(), of_clocks.checks.end());
  std::ranges::sort(report.times);
  measure_coverage(report, std::move(spans), duration);
  const std::size_t first = report.issues.size();
  check_coverage(report, slack, short_of(observations, repeats), options);
  report.checks.insert(report.checks.begin(),
                       answered(kCoverage, "", outcome_of(report.issues, first), report.covered_s,
                                duration - 2 * slack));
  if (!intervals.empty()) {
    const auto [least, most] = std::ranges::minmax(intervals);
    report.frame_rate_least = 1 / most;
    if (least > 0) report.frame_rate_most = 1 / least;
    report.frame_rate_median = 1 / upper_median(std::move(intervals));
  }
  return report;
}

}  // namespace swarmsmith
