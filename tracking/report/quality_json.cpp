#include <nlohmann/json.hpp>

#include "sim/control/reference_model.h"
#include "tracking/report/internal/findings.h"
#include "tracking/report/quality.h"
#include "tracking/robots/reality_text.h"
#include "tracking/robots/robot_logs.h"

namespace swarmsmith {
namespace {

/// In the order of writing, which is that of reading.
using Json = nlohmann::ordered_json;

template <class Number>
Json or_null(const std::optional<Number>& value) {
  return value ? Json(*value) : Json(nullptr);
}

std::string sha256_of_file(const Rig& rig, const std::string& file) {
  const auto found = rig.files.find(file);
  return found == rig.files.end() ? "" : found->second.sha256;
}

Json calibration_json(const ReportedRun& run, const CameraFinding& finding) {
  if (finding.calibration == nullptr) return nullptr;
  const CameraCalibration& made = *finding.calibration;
  return {{"file", finding.setup->model_file},
          {"sha256", sha256_of_file(run.rig, finding.setup->model_file)},
          {"made", made.made},
          {"rms_px", made.rms_px},
          {"worst_view_px", made.worst_view_px},
          {"views", made.views},
          {"views_dropped", made.views_dropped},
          {"coverage", made.coverage},
          {"board", made.board}};
}

Json place_json(const ReportedRun& run, const CameraFinding& finding) {
  if (finding.place == nullptr) return nullptr;
  const PlaceCalibration& made = *finding.place;
  return {{"file", finding.setup->place_file},
          {"sha256", sha256_of_file(run.rig, finding.setup->place_file)},
          {"made", made.made},
          {"rms_px", made.rms_px},
          {"worst_left_out_m", made.worst_left_out_m},
          {"worst_tag", made.worst_tag},
          {"coverage", made.coverage},
          {"camera_height_m", or_null(finding.height_m)}};
}

Json camera_json(const ReportedRun& run, const CameraRecord& record) {
  const CameraFinding finding = camera_finding(run, record);
  Json tags = Json::array();
  for (const ReferenceFinding& tag : finding.references) {
    tags.push_back({{"tag", tag.tag},
                    {"seen", tag.looks},
                    {"of", finding.looks},
                    {"rms_px", tag.rms_px},
                    {"left_out_m", or_null(tag.left_out_m)},
                    {"shift_px", tag.worst_shift_px}});
  }
  return {{"camera", record.camera},
          {"file", record.file},
          {"sha256", record.sha256},
          {"width", record.size.width},
          {"height", record.size.height},
          {"frames", record.frames},
          {"damaged_frames", record.damaged_frames},
          {"times", name_of(record.time_source)},
          {"calibration", calibration_json(run, finding)},
          {"place", place_json(run, finding)},
          {"shift_px", finding.worst_shift_px},
          {"shift_at_s", finding.worst_shift_at_s},
          {"reference_tags", std::move(tags)}};
}

Json offset_json(const ReportedRun& run, std::size_t robot) {
  if (robot >= run.rig.robots.size()) return nullptr;
  const std::string& file = run.rig.robots[robot].offset_file;
  const auto found = run.rig.offsets.find(file);
  if (found == run.rig.offsets.end()) return nullptr;
  const OffsetCalibration& made = found->second;
  return {{"file", file},
          {"sha256", sha256_of_file(run.rig, file)},
          {"made", made.made},
          {"x_m", made.offset.x_m},
          {"y_m", made.offset.y_m},
          {"yaw_rad", made.offset.yaw_rad},
          {"has_yaw", made.has_yaw},
          {"rms_m", made.rms_m}};
}

Json border_json(const ReportedRun& run, std::size_t robot) {
  if (robot >= run.scored.borders.size() || !run.scored.borders[robot]) return nullptr;
  const BorderDistance& border = *run.scored.borders[robot];
  return {{"border", border.border},
          {"signed_m", border.signed_m},
          {"sigma_m", border.sigma_m},
          {"too_close", border.too_close}};
}

/// What the robot's own log says; null when it has none.
Json log_json(const ReportedRun& run, std::size_t robot) {
  const RobotLog* log = log_of(run, robot);
  if (log == nullptr) return nullptr;
  const LogHead& head = log->record.head;
  const LogCounts counts = log_counts(log->record);
  return {{"file", log->file},
          {"state", head.end ? Json(head.end->state) : Json(nullptr)},
          {"verdict", head.end ? Json(name_of(head.end->verdict)) : Json(nullptr)},
          {"reasons", head.end ? head.end->reasons : std::vector<std::string>()},
          {"stepped", counts.stepped},
          {"held", counts.held},
          {"skipped", counts.skipped},
          {"late_median_ms", counts.late_median_ms},
          {"late_most_ms", counts.late_most_ms},
          {"clock_offset_s", or_null(head.clock_offset_s)},
          {"machine_digest", head.machine_digest},
          {"host", head.host},
          {"scheduling", head.scheduling},
          {"program", head.program}};
}

Json latency_json(const ReportedRun& run, std::size_t robot) {
  if (robot >= run.scored.latencies.size() || !run.scored.latencies[robot]) return nullptr;
  const Latency& latency = *run.scored.latencies[robot];
  return {{"seconds", or_null(latency.seconds)},
          {"error_s", latency.seconds ? Json(latency.error_s) : Json(nullptr)},
          {"agreement", or_null(latency.agreement)},
          {"reason", latency.reason}};
}

Json reality_of(const ReportedRun& run, std::size_t robot) {
  if (robot >= run.scored.reality.size() || !run.scored.reality[robot]) return nullptr;
  return Json::parse(reality_json(*run.scored.reality[robot]).text());
}

Json robot_json(const ReportedRun& run, std::size_t number) {
  const TrackedRobot& robot = run.tracked.robots[number];
  const CycleCounts cycles = cycle_counts(robot);
  auto samples = sample_counts(robot);
  return {{"robot", robot.name},
          {"tag", robot.tag},
          {"cycles",
           {{"measured", cycles.measured},
            {"interpolated", cycles.interpolated},
            {"degraded", cycles.degraded},
            {"missing", cycles.missing}}},
          {"longest_gap_s", robot.longest_gap_s},
          {"longest_gap_from_s", robot.longest_gap_from_s},
          {"samples",
           {{"used", samples[Sample::Use::Used]},
            {"outliers", samples[Sample::Use::Outlier]},
            {"duplicates", samples[Sample::Use::Duplicate]},
            {"bad_fits", samples[Sample::Use::BadFit]},
            {"outside", samples[Sample::Use::Outside]}}},
          {"outliers", robot.outliers},
          {"scale", robot.mean_scale},
          {"residual_m", robot.mean_residual_m},
          {"sigma_m", robot.sigma.sigma_m},
          {"sigma_rad", robot.sigma.sigma_rad},
          {"offset", offset_json(run, number)},
          {"border", border_json(run, number)},
          {"log", log_json(run, number)},
          {"latency", latency_json(run, number)},
          {"reality", reality_of(run, number)}};
}

Json issues_json(const ReportedRun& run) {
  Json issues = Json::array();
  for (const Issue& issue : run.scored.issues) {
    issues.push_back({{"code", name_of(issue.code)},
                      {"text", issue.text},
                      {"robot", issue.robot},
                      {"from_s", or_null(issue.from)},
                      {"to_s", or_null(issue.to)}});
  }
  return issues;
}

Json checks_json(const ReportedRun& run) {
  Json checks = Json::array();
  for (const Check& check : run.scored.checks) {
    checks.push_back({{"name", check.name},
                      {"subject", check.subject},
                      {"outcome", name_of(check.outcome)},
                      {"value", or_null(check.value)},
                      {"limit", or_null(check.limit)},
                      {"unit", check.unit},
                      {"catches", check.catches},
                      {"reason", check.reason}});
  }
  return checks;
}

Json overrides_json(const ReportedRun& run) {
  Json overrides = Json::array();
  for (const VerdictOverride& each : run.overrides) {
    overrides.push_back(
        {{"verdict", name_of(each.verdict)}, {"who", each.who}, {"reason", each.reason}});
  }
  return overrides;
}

}  // namespace

std::string quality_json(const ReportedRun& run) {
  const TrackedRun& tracked = run.tracked;
  Json cameras = Json::array();
  for (const CameraRecord& record : run.observations.cameras)
    cameras.push_back(camera_json(run, record));
  Json robots = Json::array();
  for (std::size_t i = 0; i < tracked.robots.size(); ++i)
    robots.push_back(robot_json(run, i));
  const Json report = {{"format", 1},
                       {"run",
                        {{"name", run.log.name},
                         {"recorded", run.log.recorded},
                         {"mission", run.log.mission.name},
                         {"source", run.log.source},
                         {"design", run.log.design},
                         {"candidate", run.log.candidate},
                         {"duration_s", tracked.trajectory.instants() * kControlPeriod_s}}},
                       {"verdict", name_of(counting_verdict(run))},
                       {"measured_verdict", name_of(run.scored.verdict)},
                       {"reasons", run.scored.reasons},
                       {"overrides", overrides_json(run)},
                       {"score", or_null(run.scored.score)},
                       {"biased", run.scored.biased},
                       {"frames",
                        {{"read", tracked.frames},
                         {"dropped", tracked.frames_dropped},
                         {"twice", tracked.frames_twice},
                         {"rate_least", tracked.frame_rate_least},
                         {"rate_median", tracked.frame_rate_median},
                         {"rate_most", tracked.frame_rate_most},
                         {"covered_s", tracked.covered_s}}},
                       {"robots", std::move(robots)},
                       {"cameras", std::move(cameras)},
                       {"issues", issues_json(run)},
                       {"not_checked", unasked(run.scored.checks)},
                       {"checks", checks_json(run)},
                       {"patches", run.patches.size()},
                       {"program", run.program}};
  return report.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace swarmsmith
