#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "analysis/arena/arena_picture.h"
#include "analysis/report/html.h"
#include "sim/control/reference_model.h"
#include "tracking/report/internal/reality_table.h"
#include "tracking/report/quality.h"
#include "tracking/report/timeline.h"

namespace swarmsmith {
namespace {

using Facts = std::vector<std::pair<std::string, std::string>>;

constexpr double kPictureWidth_mm = 96;
constexpr double kTimelineWidth_mm = 170;
constexpr std::size_t kShownHash = 16;

std::string percent(std::int64_t part, std::int64_t of) {
  return of == 0
             ? "-"
             : fmt::format("{:.1f} %", 100.0 * static_cast<double>(part) / static_cast<double>(of));
}

std::string in_mm(double metres, int decimals = 1) {
  return fmt::format("{:.{}f}", 1000 * metres, decimals);
}

double degrees(double radians) {
  return radians * 180 / std::numbers::pi;
}

/// Converts "2026-11-21T14:03:00Z" to "2026-11-21 14:03".
std::string date_text(const std::string& made) {
  constexpr std::size_t kToMinutes = 16;
  std::string text = made.substr(0, kToMinutes);
  if (const std::size_t at = text.find('T'); at != std::string::npos) text[at] = ' ';
  return text.empty() ? "not known" : text;
}

std::string score_text(const ScoredRun& scored) {
  return scored.score ? shown_number(*scored.score) : "none";
}

std::string span_text(const Issue& issue) {
  if (!issue.from) return "";
  if (!issue.to || *issue.to == *issue.from) return fmt::format("{:.1f}", *issue.from);
  return fmt::format("{:.1f} to {:.1f}", *issue.from, *issue.to);
}

void write_verdict(HtmlPage& page, const RunFindings& run) {
  page.heading(2, fmt::format("Verdict: {}", name_of(run.verdict())));
  if (const VerdictOverride* by_person = overriding(run.overrides)) {
    page.paragraph(fmt::format("{} has set the verdict to {}: {}. As measured it was {}.",
                               by_person->who, name_of(by_person->verdict), by_person->reason,
                               name_of(run.scored.verdict)));
  } else if (!run.overrides.empty()) {
    const VerdictOverride& last = run.overrides.back();
    page.paragraph(
        fmt::format("{} had set the verdict to {}: {}. That no longer counts: the run was scored "
                    "again since, with other inputs or another result.",
                    last.who, name_of(last.verdict), last.reason));
  }
  for (const std::string& reason : run.scored.reasons)
    page.paragraph(reason);
  if (run.scored.reasons.empty()) page.paragraph("There are no objections to the score.");
  if (const auto missing = unasked(run.scored.checks); !missing.empty())
    page.paragraph(fmt::format("Not checked: {}.", fmt::join(missing, ", ")));
  if (run.scored.biased) {
    page.paragraph(
        "BIASED: a tag was used as its robot's centre, which makes scores look better than they "
        "are.");
  }
  const RunLog& log = run.log;
  Facts facts = {{"Score", score_text(run.scored)},
                 {"Mission", log.mission.name},
                 {"Recorded", log.recorded.empty() ? "the run log gives no date" : log.recorded},
                 {"Source", log.source}};
  if (!log.design.empty()) facts.emplace_back("Design", log.design);
  if (!log.candidate.empty()) facts.emplace_back("Candidate", log.candidate);
  facts.emplace_back("Duration",
                     fmt::format("{:.1f} s", run.tracked.trajectory.instants() * kControlPeriod_s));
  facts.emplace_back("Covered by video", fmt::format("{:.1f} s", run.tracked.covered_s));
  page.facts("The run", facts);
}

void write_pictures(HtmlPage& page, const RunFindings& run) {
  page.heading(2, "What the camera saw");
  ArenaPicture picture{.title = run.log.name,
                       .details = {run.log.mission.name, "score " + score_text(run.scored),
                                   std::string(name_of(run.verdict()))},
                       .arena = run.log.mission.arena,
                       .body = run.log.mission.robot.body.outline,
                       .width_mm = kPictureWidth_mm};
  const int cycles = run.tracked.trajectory.instants();
  picture.cycles_a_mark = cycles <= 300 ? 50 : cycles <= 600 ? 100 : 300;
  picture.arena.patches.insert(picture.arena.patches.end(), run.scored.patches.begin(),
                               run.scored.patches.end());
  const std::size_t robots = run.tracked.robots.size();
  for (std::size_t i = 0; i < robots; ++i) {
    PicturedRobot robot{.label = run.tracked.robots[i].name};
    if (i < run.tracked.starts.size()) robot.poses.push_back(run.tracked.starts[i]);
    for (int instant = 0; instant < run.tracked.trajectory.instants(); ++instant)
      robot.poses.push_back(run.tracked.trajectory.at(instant)[i]);
    picture.robots.push_back(std::move(robot));
  }
  page.picture(draw(picture),
               fmt::format("From above: hollow at the start, solid at the end, trails between them "
                           "with the time in seconds each {} s.",
                           picture.cycles_a_mark / 10));
  page.picture(timeline(run.tracked, run.scored.issues, kTimelineWidth_mm),
               "How each robot's pose was obtained, and when something was wrong.");
}

std::string border_text(const BorderDistance& border) {
  return fmt::format("{:+.1f}, {}{}", 1000 * border.signed_m, border.border,
                     border.too_close ? ": TOO CLOSE TO CALL" : "");
}

std::string offset_text(const RobotFinding& robot) {
  if (robot.setup == nullptr) return "none";
  if (robot.offset == nullptr) return "none: tag used as centre";
  const OffsetCalibration& made = *robot.offset;
  return fmt::format("{}, {} ({})", in_mm(made.offset.x_m), in_mm(made.offset.y_m),
                     date_text(made.made));
}

void write_robots(HtmlPage& page, const RunFindings& run) {
  page.heading(2, "Robots");
  HtmlTable cycles{.caption =
                       "Control cycles of 0.1 s, and samples (one a frame in which the tag "
                       "was found). Limits: 5 % not measured, gaps of 1 s.",
                   .columns = {{"Robot"},
                               {"Tag", true},
                               {"Measured", true},
                               {"Interpolated", true},
                               {"Degraded", true},
                               {"Missing", true},
                               {"Longest gap (s)", true},
                               {"from (s)", true},
                               {"Samples", true},
                               {"Dropped", true}}};
  HtmlTable quality{
      .caption =
          "How well tags fit: measured over declared edge (over 1 % off is a warning, over "
          "3 % an error), corners about a rigid square (up to 1.5 mm), estimated noise of "
          "the centre and the heading.",
      .columns = {{"Robot"},
                  {"Scale", true},
                  {"Residual (mm)", true},
                  {"Sigma x, y (mm)", true},
                  {"Sigma heading (deg)", true},
                  {"Tag's offset x, y (mm) and date"}}};
  HtmlTable borders{.caption = "Distance to the nearest border at the end (mm), positive inside",
                    .columns = {{"Robot"}, {"Distance and border"}}};
  for (const RobotFinding& robot : run.robots) {
    const TrackedRobot& tracked = *robot.tracked;
    const auto part = [&](CycleKind kind) {
      return percent(robot.cycles(kind), static_cast<std::int64_t>(tracked.cycles.size()));
    };
    const std::int64_t used = robot.samples(Sample::Use::Used);
    cycles.rows.push_back(
        {tracked.name, std::to_string(tracked.tag), part(CycleKind::Measured),
         part(CycleKind::Interpolated), part(CycleKind::Degraded), part(CycleKind::Missing),
         fmt::format("{:.2f}", tracked.longest_gap_s),
         fmt::format("{:.1f}", tracked.longest_gap_from_s), std::to_string(used),
         std::to_string(static_cast<std::int64_t>(tracked.samples.size()) - used)});
    quality.rows.push_back({tracked.name, fmt::format("{:.4f}", tracked.mean_scale),
                            in_mm(tracked.mean_residual_m, 2), in_mm(tracked.sigma.sigma_m, 2),
                            fmt::format("{:.2f}", degrees(tracked.sigma.sigma_rad)),
                            offset_text(robot)});
    if (robot.border != nullptr) borders.rows.push_back({tracked.name, border_text(*robot.border)});
  }
  page.table(cycles);
  page.table(quality);
  page.table(borders);
}

std::string latency_text(const Latency& latency) {
  if (!latency.seconds) return "cannot be determined: " + latency.reason;
  return fmt::format("{:.0f} +- {:.1f}", 1000 * *latency.seconds, 1000 * latency.error_s);
}

void write_logs(HtmlPage& page, const RunFindings& run) {
  HtmlTable logs{.caption =
                     "What the robots recorded themselves: control cycles, and how late they "
                     "began; the latency is how long after the commands the camera saw the "
                     "motion.",
                 .columns = {{"Robot"},
                             {"Its verdict"},
                             {"Stepped", true},
                             {"Held", true},
                             {"Skipped", true},
                             {"Late, median, most (ms)", true},
                             {"Clock offset (ms)", true},
                             {"Latency (ms)"},
                             {"Scheduling"}}};
  for (const RobotFinding& robot : run.robots) {
    if (robot.log == nullptr) continue;
    const LogHead& head = robot.log->record.head;
    const LogCounts& counts = robot.logged;
    logs.rows.push_back(
        {robot.tracked->name,
         head.end ? std::string(name_of(head.end->verdict)) : "none: it was killed",
         std::to_string(counts.stepped), std::to_string(counts.held),
         std::to_string(counts.skipped),
         fmt::format("{:.1f}, {:.1f}", counts.late_median_ms, counts.late_most_ms),
         head.clock_offset_s ? fmt::format("{:+.1f}", 1000 * *head.clock_offset_s) : "-",
         robot.latency == nullptr ? "-" : latency_text(*robot.latency), head.scheduling});
  }
  if (logs.rows.empty()) return;
  page.heading(2, "Robots' logs");
  page.table(logs);
  if (const HtmlTable table = reality_table(run); !table.rows.empty()) page.table(table);
}

void write_frames(HtmlPage& page, const RunFindings& run) {
  const TrackedRun& tracked = run.tracked;
  page.heading(2, "Frames");
  page.facts("All cameras together",
             {{"Read", std::to_string(tracked.frames)},
              {"Dropped", fmt::format("{} ({})", tracked.frames_dropped,
                                      percent(tracked.frames_dropped,
                                              tracked.frames + tracked.frames_dropped))},
              {"Same picture again", std::to_string(tracked.frames_twice)},
              {"Frames a second", fmt::format("{:.2f} / {:.2f} / {:.2f} (least, median, most)",
                                              tracked.frame_rate_least, tracked.frame_rate_median,
                                              tracked.frame_rate_most)}});
}

void write_camera(HtmlPage& page, const CameraFinding& camera) {
  const CameraRecord& record = *camera.record;
  Facts facts = {{"Video", record.file},
                 {"Size", fmt::format("{} x {}", record.size.width, record.size.height)},
                 {"Frames", fmt::format("{}, damaged {}", record.frames, record.damaged_frames)},
                 {"Times from", std::string(name_of(record.time_source))}};
  if (camera.calibration != nullptr) {
    const CameraCalibration& made = *camera.calibration;
    facts.emplace_back("Lens calibrated",
                       fmt::format("{}: {:.3f} px RMS, worst view {:.3f} px, {} views, {:.0f} % of "
                                   "the frame",
                                   date_text(made.made), made.rms_px, made.worst_view_px,
                                   made.views, 100 * made.coverage));
  }
  if (camera.place != nullptr) {
    const PlaceCalibration& made = *camera.place;
    facts.emplace_back(
        "Place calibrated",
        fmt::format(
            "{}: {:.3f} px RMS, worst left out tag {} at {} mm, tags around {:.0f} % of the "
            "arena",
            date_text(made.made), made.rms_px, made.worst_tag, in_mm(made.worst_left_out_m),
            100 * made.coverage));
    facts.emplace_back("Height", fmt::format("{:.3f} m above the floor", *camera.height_m));
  }
  facts.emplace_back("Camera moved",
                     fmt::format("at most {:.2f} px (at {:.1f} s of its clock; limit 1 px)",
                                 camera.worst_shift_px, camera.worst_shift_at_s));
  page.facts("Camera " + record.camera, facts);
  HtmlTable tags{.caption = "Floor tags of camera " + record.camera,
                 .columns = {{"Tag"},
                             {"Seen", true},
                             {"Reprojection (px)", true},
                             {"Floor error when left out (mm)", true},
                             {"Shift in this run (px)", true}}};
  for (const ReferenceFinding& tag : camera.references) {
    tags.rows.push_back({std::to_string(tag.tag), fmt::format("{} of {}", tag.looks, camera.looks),
                         fmt::format("{:.3f}", tag.rms_px),
                         tag.left_out_m ? in_mm(*tag.left_out_m) : "-",
                         fmt::format("{:.2f}", tag.worst_shift_px)});
  }
  page.table(tags);
}

void write_issues(HtmlPage& page, const RunFindings& run) {
  page.heading(2, "Issues");
  if (run.scored.issues.empty()) page.paragraph("None.");
  HtmlTable issues{.caption =
                       "What docs/tracking.md says of each code: E_ makes a run invalid or "
                       "stops it, W_ is a warning",
                   .columns = {{"Code"}, {"Robot"}, {"Time (s)"}, {"What"}}};
  for (const Issue& issue : run.scored.issues) {
    issues.rows.push_back(
        {std::string(name_of(issue.code)), issue.robot, span_text(issue), issue.text});
  }
  page.table(issues);
}

/// Writes all checks, those that did not pass first.
void write_checks(HtmlPage& page, const RunFindings& run) {
  page.heading(2, "Checks");
  const auto& checks = run.scored.checks;
  const auto count = [&](Check::Outcome outcome) {
    return std::ranges::count(checks, outcome, &Check::outcome);
  };
  page.paragraph(fmt::format("{} of {} checks passed, {} warned, {} failed, {} could not run.",
                             count(Check::Outcome::Passed), checks.size(),
                             count(Check::Outcome::Warned), count(Check::Outcome::Failed),
                             count(Check::Outcome::NotRun)));
  HtmlTable table{.caption =
                      "The checks of the run, which decide whether its score counts, and what each "
                      "can find",
                  .columns = {{"Outcome"},
                              {"Check"},
                              {"Of"},
                              {"Number"},  // contains words, and may wrap
                              {"Limit"},
                              {"What it catches; why it could not run"}}};
  for (const auto outcome : kWorstFirst) {
    for (const Check& check : checks) {
      if (check.outcome != outcome) continue;
      table.rows.push_back(
          {std::string(name_of(outcome)), check.name, check.subject, value_text(check),
           limit_text(check),
           check.reason.empty() ? check.catches : check.catches + "; " + check.reason});
    }
  }
  page.table(table);
}

void write_origin(HtmlPage& page, const RunFindings& run) {
  page.heading(2, "Where it comes from");
  page.paragraph("Scored by " + run.program + ".");
  HtmlTable files{.caption = "SHA-256 of the files, first digits",
                  .columns = {{"File"}, {"SHA-256"}, {"Made"}}};
  for (const CameraRecord& record : run.observations.cameras)
    files.rows.push_back({record.file, record.sha256.substr(0, kShownHash), ""});
  for (const auto& [name, file] : run.rig.files)
    files.rows.push_back({name, file.sha256.substr(0, kShownHash), date_text(file.made)});
  page.table(files);
  constexpr std::string_view kSources[] = {"none", "the run log", "measured from the image"};
  page.facts("Colour patches",
             {{"From", std::string(kSources[static_cast<std::size_t>(run.log.layout.source)])},
              {"Patches of this run", std::to_string(run.scored.patches.size())}});
}

}  // namespace

std::string quality_html(const RunFindings& run) {
  HtmlPage page;
  write_verdict(page, run);
  write_pictures(page, run);
  write_robots(page, run);
  write_logs(page, run);
  write_issues(page, run);
  write_checks(page, run);
  write_frames(page, run);
  page.heading(2, "Cameras and floor tags");
  for (const CameraFinding& camera : run.cameras)
    write_camera(page, camera);
  write_origin(page, run);
  return page.finish(fmt::format("{}: {}", run.log.name, name_of(run.verdict())),
                     fmt::format("{}{}, score {}{}", run.log.mission.name,
                                 run.log.recorded.empty() ? "" : " of " + run.log.recorded,
                                 score_text(run.scored), run.scored.biased ? " (BIASED)" : ""));
}

}  // namespace swarmsmith
