#include "tracking/app/run_analysis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/control/treads.h"
#include "tracking/app/run_checks.h"
#include "tracking/observing/sync_event.h"
#include "tracking/robots/robot_logs.h"
#include "tracking/scoring/score_run.h"

namespace swarmsmith::cli {
namespace {

constexpr Question kWhole{"film read to its end", "", "a film that was cut, or copied in part"};
constexpr Question kStart{"start as the sync tag says", "s",
                          "a wrong `start`; the film of another run"};

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
void check_start(const Observations& observations, const RunLog& log, std::vector<Issue>& issues,
                 std::vector<Check>& checks) {
  if (!log.start.time_s || log.start.sync == RunStart::Sync::None) {
    checks.push_back(not_asked(kStart, "",
                               log.start.time_s ? "the run log names no `sync` tag"
                                                : "the run log gives no `start` beside it"));
    return;
  }
  const auto sync = sync_of(observations, log);
  const double late_s = sync ? *sync - *log.start.time_s : 0;
  const bool is_right = sync && std::fabs(late_s) <= kSyncTolerance_s;
  checks.push_back(answered(kStart, "", is_right ? Check::Outcome::Passed : Check::Outcome::Warned,
                            sync ? std::optional(std::fabs(late_s)) : std::nullopt,
                            kSyncTolerance_s));
  if (is_right) return;
  issues.push_back(
      {IssueCode::SyncDiffers,
       sync ? fmt::format("the run starts at {:.2f} s of the first video by `start`, and at {:.2f} "
                          "s by tag {} (they may differ by {:g} s); was the video recorded on the "
                          "host that started the robots, and is it that of this run?",
                          *log.start.time_s, *sync, log.start.sync_tag, kSyncTolerance_s)
            : "`start` could not be checked: " + sync.error().message,
       {},
       {},
       {}});
}

/// Nodes cut commands that are faster than they allow.
void know_speeds(const std::vector<RobotLog>& logs, TrackLimits& limits) {
  double most = 0;
  for (const RobotLog& log : logs)
    most = std::max(most, log.record.head.max_mps);
  if (!(most > 0)) return;
  limits.driving_speed_m_s = most;
  limits.driving_turn_rad_s = 2 * most / kTreadDistance_m;
  limits.knows_driving_speed = true;
}

/// The film's clock was counted, and the robots' clocks agree with it.
void believe_clock(TrackedRun& run) {
  std::erase_if(run.issues,
                [](const Issue& issue) { return issue.code == IssueCode::ClockCounted; });
  for (Check& check : run.checks) {
    if (check.name == kClockOfTheFilm) check.outcome = Check::Outcome::Passed;
  }
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
  options.body = log.mission.body;
  options.scored_at_the_end = is_scored_at_the_end(log.mission);
  options.takes_tags_for_centres = takes_tags_for_centres;
  know_speeds(observations.logs, options.limits);
  auto tracked = track_run(observations, rig, log.mission.arena, options);
  if (!tracked) return refused(tracked.error());
  analysis.tracked = std::move(*tracked);
  RobotFindings robots = judge_robots(analysis.tracked, observations.logs, log);
  analysis.tracked.checks.insert(analysis.tracked.checks.end(), robots.checks.begin(),
                                 robots.checks.end());
  if (robots.logs_confirm_clock) believe_clock(analysis.tracked);
  std::vector<Issue> before = observations.issues;
  std::vector<Check> asked{answered(kWhole, "", outcome_of(before, 0, IssueCode::VideoTruncated))};
  check_start(observations, log, before, asked);
  before.insert(before.end(), robots.issues.begin(), robots.issues.end());
  const auto of_logs = checks_of_logs(analysis.tracked, observations, log, robots);
  asked.insert(asked.end(), of_logs.begin(), of_logs.end());
  auto scored = score_run(analysis.tracked, log.mission, said_patches(log), before, asked);
  if (!scored) return refused(scored.error());
  analysis.scored = std::move(*scored);
  analysis.scored.latencies = std::move(robots.latencies);
  analysis.scored.reality = std::move(robots.reality);
  return analysis;
}

}  // namespace swarmsmith::cli
