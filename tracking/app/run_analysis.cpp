#include "tracking/app/run_analysis.h"

#include <fmt/format.h>

#include <cmath>

#include "tracking/app/run_checks.h"
#include "tracking/observing/sync_event.h"
#include "tracking/robots/robot_logs.h"
#include "tracking/scoring/score_run.h"

namespace swarmsmith::cli {
namespace {

/// A person who covers the tag by hand is that late, or early, at most.
constexpr double kSyncTolerance_s = 1;

/// When the sync tag was covered, or laid open, on the clock of the first camera.
Expected<double> sync_of(const Observations& observations, const RunLog& log) {
  // The first camera that shows the event tells it.
  for (std::size_t i = 0; i < log.videos.size(); ++i) {
    auto instant = sync_instant(observations, static_cast<int>(i), log.start);
    if (instant) return *instant - log.videos[i].clock_ahead_s;
    if (i + 1 == log.videos.size()) return Unexpected(instant.error());
  }
  return Unexpected(error_of(IssueCode::Config, "the run log has no video", log.name));
}

/// The run's begin on the clock of the first camera.
Expected<double> start_of(const Observations& observations, const RunLog& log) {
  if (log.start.time_s) return *log.start.time_s;
  return sync_of(observations, log);
}

/// Where the log says both, the tag is a check of `start`.
std::optional<Issue> sync_issue(const Observations& observations, const RunLog& log) {
  if (!log.start.time_s || log.start.sync == RunStart::Sync::None) return std::nullopt;
  const auto said = [](std::string text) {
    return Issue{IssueCode::SyncDiffers, std::move(text), {}, {}, {}};
  };
  const auto sync = sync_of(observations, log);
  if (!sync) return said("`start` could not be checked: " + sync.error().message);
  const double late_s = *sync - *log.start.time_s;
  if (std::fabs(late_s) <= kSyncTolerance_s) return std::nullopt;
  return said(fmt::format(
      "the run starts at {:.2f} s of the first video by `start`, and at {:.2f} s by tag "
      "{} (they may differ by {:g} s); was the video recorded on the host that started "
      "the robots, and is it that of this run?",
      *log.start.time_s, *sync, log.start.sync_tag, kSyncTolerance_s));
}

}  // namespace

OrRefusal<RunAnalysis> analyse(const Observations& observations, const Rig& rig,
                               const Rig& whole_rig, const RunLog& log,
                               bool takes_tags_for_centres) {
  RunAnalysis analysis;
  const auto start = start_of(observations, log);
  if (!start) return refused(start.error());
  for (const RunVideo& video : log.videos)
    analysis.starts_s.push_back(*start + video.clock_ahead_s);
  TrackOptions options;
  options.span = {analysis.starts_s, log.mission.cycles, {}};
  for (const RunVideo& video : log.videos)
    options.span.lengths_s.push_back(video.length_s);
  options.other_tags = other_tags(whole_rig, log);
  options.points = log.points;
  options.scored_at_the_end = is_scored_at_the_end(log.mission);
  options.takes_tags_for_centres = takes_tags_for_centres;
  auto tracked = track_run(observations, rig, log.mission.arena, options);
  if (!tracked) return refused(tracked.error());
  analysis.tracked = std::move(*tracked);
  RobotFindings robots = judge_robots(analysis.tracked, observations.logs, log);
  std::vector<Issue> before = observations.issues;
  if (auto differs = sync_issue(observations, log)) before.push_back(std::move(*differs));
  before.insert(before.end(), robots.issues.begin(), robots.issues.end());
  auto scored = score_run(analysis.tracked, log.mission, said_patches(log), before);
  if (!scored) return refused(scored.error());
  analysis.scored = std::move(*scored);
  analysis.scored.latencies = std::move(robots.latencies);
  analysis.scored.reality = std::move(robots.reality);
  return analysis;
}

}  // namespace swarmsmith::cli
