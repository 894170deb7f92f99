#include "tracking/app/run_report.h"

#include "tracking/app/commands.h"
#include "tracking/scoring/real_run_rows.h"

namespace swarmsmith::cli {

ReportedRun reported_run(const Rig& rig, const RunLog& log, const Observations& observations,
                         const RunAnalysis& analysis) {
  return {.rig = rig,
          .log = log,
          .observations = observations,
          .tracked = analysis.tracked,
          .scored = analysis.scored,
          .patches = analysis.scored.patches,
          .overrides = {},
          .program = track_program_name()};
}

RealRunRows rows_of(const ReportedRun& reported, const RunAnalysis& analysis,
                    const std::string& arena_text, CandidateId candidate) {
  RealRunRows rows = real_run_rows({.rig = reported.rig,
                                    .arena_text = arena_text,
                                    .log = reported.log,
                                    .observations = reported.observations,
                                    .starts_s = analysis.starts_s,
                                    .tracked = analysis.tracked,
                                    .patches = analysis.scored.patches,
                                    .scored = analysis.scored});
  rows.candidate = candidate;
  rows.score.report = quality_json(reported);
  rows.score.program = reported.program;
  return rows;
}

}  // namespace swarmsmith::cli
