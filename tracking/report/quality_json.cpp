#include <nlohmann/json.hpp>

#include "sim/control/reference_model.h"
#include "tracking/report/quality.h"
#include "tracking/robots/reality_text.h"

namespace swarmsmith {
namespace {

/// Keeps the order in which keys are written, which is also the reading order.
using Json = nlohmann::ordered_json;

template <class Number>
Json or_null(const std::optional<Number>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json calibration_json(const CameraFinding& camera) {
  if (camera.calibration == nullptr) return nullptr;
  const CameraCalibration& made = *camera.calibration;
  return {{"file", camera.setup->model_file},
          {"sha256", camera.calibration_sha256},
          {"made", made.made},
          {"rms_px", made.rms_px},
          {"worst_view_px", made.worst_view_px},
          {"views", made.views},
          {"views_dropped", made.views_dropped},
          {"coverage", made.coverage},
          {"board", made.board}};
}

Json place_json(const CameraFinding& camera) {
  if (camera.place == nullptr) return nullptr;
  const PlaceCalibration& made = *camera.place;
  return {{"file", camera.setup->place_file},
          {"sha256", camera.place_sha256},
          {"made", made.made},
          {"rms_px", made.rms_px},
          {"worst_left_out_m", made.worst_left_out_m},
          {"worst_tag", made.worst_tag},
          {"coverage", made.coverage},
          {"camera_height_m", or_null(camera.height_m)}};
}

Json camera_json(const CameraFinding& camera) {
  const CameraRecord& record = *camera.record;
  Json tags = Json::array();
  for (const ReferenceFinding& tag : camera.references) {
    tags.push_back({{"tag", tag.tag},
                    {"seen", tag.looks},
                    {"of", camera.looks},
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
          {"calibration", calibration_json(camera)},
          {"place", place_json(camera)},
          {"shift_px", camera.worst_shift_px},
          {"shift_at_s", camera.worst_shift_at_s},
          {"reference_tags", std::move(tags)}};
}

Json offset_json(const RobotFinding& robot) {
  if (robot.offset == nullptr) return nullptr;
  const OffsetCalibration& made = *robot.offset;
  return {{"file", robot.setup->offset_file},
          {"sha256", robot.offset_sha256},
          {"made", made.made},
          {"x_m", made.offset.x_m},
          {"y_m", made.offset.y_m},
          {"yaw_rad", made.offset.yaw_rad},
          {"has_yaw", made.has_yaw},
          {"rms_m", made.rms_m}};
}

Json border_json(const RobotFinding& robot) {
  if (robot.border == nullptr) return nullptr;
  return {{"border", robot.border->border},
          {"signed_m", robot.border->signed_m},
          {"sigma_m", robot.border->sigma_m},
          {"too_close", robot.border->too_close}};
}

/// The data from the robot's own log.
Json log_json(const RobotFinding& robot) {
  if (robot.log == nullptr) return nullptr;
  const LogHead& head = robot.log->record.head;
  return {{"file", robot.log->file},
          {"state", head.end ? Json(head.end->state) : Json(nullptr)},
          {"verdict", head.end ? Json(name_of(head.end->verdict)) : Json(nullptr)},
          {"reasons", head.end ? head.end->reasons : std::vector<std::string>()},
          {"stepped", robot.logged.stepped},
          {"held", robot.logged.held},
          {"skipped", robot.logged.skipped},
          {"late_median_ms", robot.logged.late_median_ms},
          {"late_most_ms", robot.logged.late_most_ms},
          {"clock_offset_s", or_null(head.clock_offset_s)},
          {"machine_digest", head.machine_digest},
          {"host", head.host},
          {"scheduling", head.scheduling},
          {"program", head.program}};
}

Json latency_json(const RobotFinding& robot) {
  if (robot.latency == nullptr) return nullptr;
  const Latency& latency = *robot.latency;
  return {{"seconds", or_null(latency.seconds)},
          {"error_s", latency.seconds ? Json(latency.error_s) : Json(nullptr)},
          {"agreement", or_null(latency.agreement)},
          {"reason", latency.reason}};
}

Json robot_json(const RobotFinding& robot) {
  const TrackedRobot& tracked = *robot.tracked;
  return {{"robot", tracked.name},
          {"tag", tracked.tag},
          {"cycles",
           {{"measured", robot.cycles(CycleKind::Measured)},
            {"interpolated", robot.cycles(CycleKind::Interpolated)},
            {"degraded", robot.cycles(CycleKind::Degraded)},
            {"missing", robot.cycles(CycleKind::Missing)}}},
          {"longest_gap_s", tracked.longest_gap_s},
          {"longest_gap_from_s", tracked.longest_gap_from_s},
          {"samples",
           {{"used", robot.samples(Sample::Use::Used)},
            {"outliers", robot.samples(Sample::Use::Outlier)},
            {"duplicates", robot.samples(Sample::Use::Duplicate)},
            {"bad_fits", robot.samples(Sample::Use::BadFit)},
            {"outside", robot.samples(Sample::Use::Outside)}}},
          {"outliers", tracked.outliers},
          {"scale", tracked.mean_scale},
          {"residual_m", tracked.mean_residual_m},
          {"sigma_m", tracked.sigma.sigma_m},
          {"sigma_rad", tracked.sigma.sigma_rad},
          {"offset", offset_json(robot)},
          {"border", border_json(robot)},
          {"log", log_json(robot)},
          {"latency", latency_json(robot)},
          {"reality", robot.reality == nullptr ? Json(nullptr)
                                               : Json::parse(reality_json(*robot.reality).text())}};
}

Json issues_json(const RunFindings& run) {
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

Json checks_json(const RunFindings& run) {
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

Json overrides_json(const RunFindings& run) {
  Json overrides = Json::array();
  for (const VerdictOverride& each : run.overrides) {
    overrides.push_back({{"verdict", name_of(each.verdict)},
                         {"who", each.who},
                         {"reason", each.reason},
                         {"counts", each.counts}});
  }
  return overrides;
}

}  // namespace

std::string quality_json(const RunFindings& run) {
  const TrackedRun& tracked = run.tracked;
  Json cameras = Json::array();
  for (const CameraFinding& camera : run.cameras)
    cameras.push_back(camera_json(camera));
  Json robots = Json::array();
  for (const RobotFinding& robot : run.robots)
    robots.push_back(robot_json(robot));
  const Json report = {{"format", 1},
                       {"run",
                        {{"name", run.log.name},
                         {"recorded", run.log.recorded},
                         {"mission", run.log.mission.name},
                         {"source", run.log.source},
                         {"design", run.log.design},
                         {"candidate", run.log.candidate},
                         {"duration_s", tracked.trajectory.instants() * kControlPeriod_s}}},
                       {"verdict", name_of(run.verdict())},
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
                       {"patches", run.scored.patches.size()},
                       {"program", run.program}};
  return report.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace swarmsmith
