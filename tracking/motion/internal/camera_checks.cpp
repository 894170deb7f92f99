#include "tracking/motion/internal/camera_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "tracking/motion/internal/camera_moved.h"
#include "tracking/motion/resampling.h"

namespace swarmsmith {
namespace {

constexpr Question kCoverage{"film covers the run", "s", "a start or an end that no camera filmed"};
constexpr Question kRate{"frame rate", "frames/s", "turns and gaps between two frames"};
constexpr Question kDropped{"dropped frames", "%", "a recorder that cannot keep up"};
constexpr Question kLength{"length of the film", "s", "a film that plays too fast or too slowly"};

double duration_of(const TrackOptions& options) {
  return instant_s(options.span.cycles);
}

/// Sorts; the larger of the two in the middle. 0 for none.
double median(std::vector<double>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// One camera's frames on the clock of the run.
struct FramesOfRun {
  std::vector<double> times;      ///< all
  std::vector<double> intervals;  ///< between those within the run
  std::int64_t within = 0;
  double usual_s = 0;  ///< median of the intervals
};

FramesOfRun frames_of(const CameraRecord& record, double start_s, double duration_s) {
  FramesOfRun frames;
  for (const double time : record.frame_times)
    frames.times.push_back(time - start_s);
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
  std::vector<double> sorted = frames.intervals;
  frames.usual_s = median(sorted);
  return frames;
}

/// Frames that are missing between others, by the usual interval.
std::int64_t dropped_in(const FramesOfRun& frames) {
  std::int64_t dropped = 0;
  for (const double interval : frames.intervals) {
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
  // Clocks round to milliseconds: 10 frames a second may look like 9.99.
  constexpr double kRounding = 0.99;
  if (frames.usual_s > 0 && 1 / frames.usual_s < kRounding * limits.least_frame_rate) {
    issues.push_back({IssueCode::FrameRate,
                      fmt::format("camera {} took {:.1f} frames/s, at least {:.0f} are needed; "
                                  "film at 15 to 30 frames/s",
                                  camera, 1 / frames.usual_s, limits.least_frame_rate),
                      {},
                      {},
                      {}});
  }
  const auto all = static_cast<double>(frames.within + dropped);
  if (all > 0 && static_cast<double>(dropped) > limits.dropped_share * all) {
    issues.push_back({IssueCode::FramesDropped,
                      fmt::format("camera {} dropped {} of {:.0f} frames ({:.1f} %, limit {:.0f} "
                                  "%); a faster disk or a lower frame rate helps",
                                  camera, dropped, all, 100 * static_cast<double>(dropped) / all,
                                  100 * limits.dropped_share),
                      {},
                      {},
                      {}});
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

/// Files that count frames instead of timing them play too fast when frames were dropped; only
/// their length shows it (tracking facts, section 7).
void check_length(const CameraRecord& record, const FramesOfRun& frames, const std::string& camera,
                  const std::optional<double>& said_s, FrameReport& report) {
  const bool is_avi = record.file.ends_with(".avi") || record.file.ends_with(".AVI");
  const bool counts = record.time_source == TimeSource::FrameRate ||
                      (is_avi && record.time_source != TimeSource::Sidecar);
  if (!said_s || !counts || frames.times.empty()) {
    report.checks.push_back(
        not_asked(kLength, camera,
                  !said_s ? "the run log gives no `length`" : "the file has times of its own"));
    return;
  }
  constexpr double kTolerance_s = 0.2;
  const double length = frames.times.back() - frames.times.front() + frames.usual_s;
  const double off_s = std::fabs(length - *said_s);
  const auto outcome = off_s <= kTolerance_s ? Check::Outcome::Passed : Check::Outcome::Failed;
  report.checks.push_back(answered(kLength, camera, outcome, off_s, kTolerance_s));
  if (outcome == Check::Outcome::Passed) return;
  report.issues.push_back(
      {IssueCode::Duration,
       fmt::format("{} lasts {:.2f} s and the run log says {:.2f} s (limit {:.1f} s): "
                   "frames were dropped and the file has no times; record a sidecar",
                   record.file, length, *said_s, kTolerance_s),
       {},
       {},
       {}});
}

/// Frames whose tags all stand on the same bits as in the frame before: the same picture again.
std::int64_t frames_twice(const Observations& observations, int camera) {
  std::map<std::int64_t, std::vector<std::array<double, 3>>> frames;
  for (const Sighting& seen : observations.sightings) {
    if (seen.camera != camera) continue;
    for (const ImagePoint& corner : seen.corners)
      frames[seen.frame].push_back({static_cast<double>(seen.tag), corner.u, corner.v});
  }
  std::int64_t twice = 0;
  const std::vector<std::array<double, 3>>* before = nullptr;
  std::int64_t number = 0;
  for (auto& [frame, tags] : frames) {
    std::ranges::sort(tags);
    if (before != nullptr && frame == number + 1 && tags == *before) ++twice;
    before = &tags;
    number = frame;
  }
  return twice;
}

void check_coverage(FrameReport& report, double slack_s, const TrackOptions& options) {
  const double duration = duration_of(options);
  const double slack_at_end = options.scored_at_the_end ? kSameInstant_s : slack_s;
  if (report.from_s <= slack_s && report.to_s >= duration - slack_at_end &&
      report.covered_s >= duration - 2 * slack_s) {
    return;
  }
  report.issues.push_back(
      {IssueCode::VideoTruncated,
       fmt::format("covered {:.2f} of {:.0f} s (from {:.2f} s to {:.2f} s): let the camera run "
                   "from before the start until after the end",
                   report.covered_s, duration, report.from_s, report.to_s),
       {},
       report.from_s,
       report.to_s});
}

/// From first to last frame of each camera, put together.
void measure_coverage(FrameReport& report, std::vector<std::pair<double, double>> spans,
                      double duration_s) {
  std::ranges::sort(spans);
  double end = 0;
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const double from = std::clamp(spans[i].first, end, duration_s);
    const double to = std::clamp(spans[i].second, end, duration_s);
    if (i == 0) report.from_s = from;
    report.covered_s += to - from;
    end = std::max(end, to);
    if (spans[i].second >= duration_s - kSameInstant_s) report.covers_the_end = true;
  }
  report.to_s = std::max(report.from_s, end);
}

}  // namespace

FrameReport frame_report(const Observations& observations, std::span<const TrackedCamera> cameras,
                         const Rig& rig, const TrackOptions& options) {
  FrameReport report;
  const double duration = duration_of(options);
  std::vector<double> intervals;
  std::vector<std::pair<double, double>> spans;
  double slack = 0;
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    const CameraRecord& record = observations.cameras[c];
    const FramesOfRun frames = frames_of(record, cameras[c].start_s, duration);
    report.times.insert(report.times.end(), frames.times.begin(), frames.times.end());
    if (!frames.times.empty()) spans.emplace_back(frames.times.front(), frames.times.back());
    intervals.insert(intervals.end(), frames.intervals.begin(), frames.intervals.end());
    const std::int64_t dropped = dropped_in(frames);
    report.frames += frames.within;
    report.dropped += dropped;
    report.twice += frames_twice(observations, static_cast<int>(c));
    slack = std::max(slack, 1.5 * frames.usual_s);
    check_rate(frames, dropped, cameras[c].name, options.limits, report);
    check_length(record, frames, cameras[c].name,
                 options.span.lengths_s.empty() ? std::nullopt : options.span.lengths_s[c], report);
    check_camera(record, cameras[c], rig, options, report.issues, report.checks);
  }
  std::ranges::sort(report.times);
  measure_coverage(report, std::move(spans), duration);
  const std::size_t first = report.issues.size();
  check_coverage(report, slack, options);
  report.checks.insert(report.checks.begin(),
                       answered(kCoverage, "", outcome_of(report.issues, first), report.covered_s,
                                duration - 2 * slack));
  if (!intervals.empty()) {
    const auto [least, most] = std::ranges::minmax(intervals);
    report.frame_rate_least = 1 / most;
    if (least > 0) report.frame_rate_most = 1 / least;
    report.frame_rate_median = 1 / median(intervals);
  }
  return report;
}

}  // namespace swarmsmith
