#include "tracking/app/run_analysis.h"

#include "tracking/app/run_checks.h"
#include "tracking/observing/sync_event.h"
#include "tracking/scoring/score_run.h"

namespace swarmsmith::cli {
namespace {

/// The run's begin on the clock of the first camera.
Expected<double> start_of(const Observations& observations, const RunLog& log) {
  if (log.start.time_s) return *log.start.time_s;
  // The first camera that shows the event tells it.
  for (std::size_t i = 0; i < log.videos.size(); ++i) {
    auto instant = sync_instant(observations, static_cast<int>(i), log.start);
    if (instant) return *instant - log.videos[i].clock_ahead_s;
    if (i + 1 == log.videos.size()) return Unexpected(instant.error());
  }
  return Unexpected(error_of(IssueCode::Config, "the run log has no video", log.name));
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
  auto scored = score_run(analysis.tracked, log.mission, said_patches(log), observations.issues);
  if (!scored) return refused(scored.error());
  analysis.scored = std::move(*scored);
  return analysis;
}

}  // namespace swarmsmith::cli
