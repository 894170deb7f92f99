#include "tracking/app/run_analysis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tracking/app/commands.h"
#include "tracking/app/run_checks.h"
#include "tracking/motion/track_run.h"
#include "tracking/observing/sync_event.h"
#include "tracking/report/quality.h"
#include "tracking/robots/robot_logs.h"
#include "tracking/scoring/real_run_rows.h"
#include "tracking/scoring/score_run.h"

namespace swarmsmith {
namespace {

constexpr Question kWhole{"film read to its end", "", "a film that was cut, or copied in part"};
constexpr Question kStart{"start as the sync tag says", "s",
                          "a wrong `start`; the film of another run"};

/// The largest error in time of a person who covers the tag by hand.
constexpr double kSyncTolerance_s = 1;

/// The time when the sync tag was covered or uncovered, on the clock of the first camera.
Expected<double> sync_of(const Observations& observations, const RunLog& log) {
  // The first camera that shows the event gives the time.
  for (std::size_t i = 0; i < log.videos.size(); ++i) {
    auto instant = sync_instant(observations, static_cast<int>(i), log.start);
    if (instant) return *instant - log.videos[i].clock_ahead_s;
    if (i + 1 == log.videos.size()) return Unexpected(instant.error());
  }
  return Unexpected(error_of(IssueCode::Config, "the run log has no video", log.name));
}

/// The start of the run on the clock of the first camera.
Expected<double> start_of(const Observations& observations, const RunLog& log) {
  if (log.start.time_s) return *log.start.time_s;
  return sync_of(observations, log);
}

/// If the log has both, the tag is used to check `start`.
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
            : "`start` could not be checked: " + sync.error().message});
}

/// The highest speed to which the robots' nodes limited commands; 0 without logs.
double logged_speed(const std::vector<RobotLog>& logs) {
  double most = 0;
  for (const RobotLog& log : logs)
    most = std::max(most, log.record.head.max_mps);
  return most;
}

/// Removes the doubt about counted frame times, because the robots' clocks agree with them.
void believe_clock(TrackedRun& run) {
  std::erase_if(run.issues,
                [](const Issue& issue) { return issue.code == IssueCode::ClockCounted; });
  for (Check& check : run.checks) {
    if (check.name == kClockOfTheFilm) check.outcome = Check::Outcome::Passed;
  }
}

}  // namespace

Expected<std::vector<double>> starts_of(const Observations& observations, const RunLog& log) {
  const auto start = start_of(observations, log);
  if (!start) return Unexpected(start.error());
  std::vector<double> starts_s;
  for (const RunVideo& video : log.videos)
    starts_s.push_back(*start + video.clock_ahead_s);
  return starts_s;
}

OrRefusal<AnalysedRun> analyse(Observations observations, const Rig& whole_rig, RunLog log,
                               bool takes_tags_for_centres) {
  auto starts_s = starts_of(observations, log);
  if (!starts_s) return refused(starts_s.error());
  AnalysedRun run{.rig = rig_of_run(whole_rig, log), .starts_s = std::move(*starts_s)};
  TrackOptions options;
  for (const RunVideo& video : log.videos)
    options.span.lengths_s.push_back(video.length_s);
  options.span.starts_s = run.starts_s;
  options.span.cycles = log.mission.cycles;
  options.other_tags = other_tags(whole_rig, log);
  options.points = log.points;
  options.body = log.mission.robot.body.outline;
  options.scored_at_the_end = is_scored_at_the_end(log.mission);
  options.takes_tags_for_centres = takes_tags_for_centres;
  options.limits = limits_of(log.mission.robot, logged_speed(observations.logs));
  auto tracked = track_run(observations, run.rig, log.mission.arena, options);
  if (!tracked) return refused(tracked.error());
  run.tracked = std::move(*tracked);
  RobotFindings robots = judge_robots(run.tracked, observations.logs, log);
  run.tracked.checks.insert(run.tracked.checks.end(), robots.checks.begin(), robots.checks.end());
  if (robots.logs_confirm_clock) believe_clock(run.tracked);
  std::vector<Issue> before = observations.issues;
  std::vector<Check> asked{answered(kWhole, "", outcome_of(before, 0, IssueCode::VideoTruncated))};
  check_start(observations, log, before, asked);
  before.insert(before.end(), robots.issues.begin(), robots.issues.end());
  const auto of_logs = checks_of_logs(run.tracked, observations, log, robots);
  asked.insert(asked.end(), of_logs.begin(), of_logs.end());
  auto scored = score_run(run.tracked, log.mission, said_patches(log), before, asked);
  if (!scored) return refused(scored.error());
  run.scored = std::move(*scored);
  run.scored.latencies = std::move(robots.latencies);
  run.scored.reality = std::move(robots.reality);
  run.log = std::move(log);
  run.observations = std::move(observations);
  return run;
}

OrRefusal<AnalysedRun> analyse_again(const RealRunRows& rows) {
  auto stored = stored_run(rows);
  if (!stored) return tl::unexpected(Refusal{ExitCode::Store, std::move(stored.error())});
  if (auto errors = settle_names(stored->log, stored->rig); !errors.empty())
    return tl::unexpected(Refusal{ExitCode::Store, std::move(errors)});
  return analyse(std::move(stored->observations), stored->rig, std::move(stored->log),
                 rows.score.biased);
}

RunFindings AnalysedRun::findings() const {
  RunFindings findings = findings_of(rig, log, observations, tracked, scored);
  findings.program = track_program_name();
  return findings;
}

RealRunRows AnalysedRun::rows(const std::string& arena_text, CandidateId candidate) const {
  const RunFindings run = findings();
  RealRunRows rows = real_run_rows(run, arena_text, starts_s);
  rows.candidate = candidate;
  rows.score.report = quality_json(run);
  rows.score.program = run.program;
  return rows;
}

}  // namespace swarmsmith
