#include <fmt/format.h>
#include <memory>

#include "base/output_file.h"
#include "base/text/json.h"
#include "base/text/whole_file.h"
#include "sim/files/robot_file.h"
#include "tracking/app/calibrate_sources.h"
#include "tracking/app/commands.h"
#include "tracking/app/refusal.h"
#include "tracking/app/run_checks.h"
#include "tracking/app/written_files.h"
#include "tracking/calibration/calibration_report.h"
#include "tracking/rig/calibration_limits.h"
#include "tracking/rig/rig_file.h"

namespace swarmsmith {
namespace {

struct RobotArguments {
  std::string robot;
  std::string kind = "rvr";
  std::string spin;
  std::string straight;
  std::string arena;
  std::string camera;
  std::string file;
  bool reverse = false;
};

Expected<RobotSetup> robot_of(const Rig& rig, const std::string& name) {
  std::vector<std::string> names;
  for (const RobotSetup& robot : rig.robots) {
    if (robot.name == name) return robot;
    names.push_back(robot.name);
  }
  return Unexpected(unknown("robot", name, names, rig.file));
}

JsonObject offset_json(const OffsetCalibration& calibration, const std::string& file) {
  return JsonObject()
      .add("file", file)
      .add("robot", calibration.robot)
      .add("tag", calibration.tag)
      .add("x_m", calibration.offset.x_m)
      .add("y_m", calibration.offset.y_m)
      .add("has_yaw", calibration.has_yaw)
      .add("yaw_rad", calibration.offset.yaw_rad)
      .add("rms_m", calibration.rms_m)
      .add("sigma_x_m", calibration.sigma_x_m)
      .add("sigma_y_m", calibration.sigma_y_m)
      .add("drift_m_s", calibration.drift_m_s)
      .add("turned_rad", calibration.turned_rad)
      .add("samples", calibration.samples);
}

/// Calibrates one of the robot's tags: offset from the spin, yaw from the straight run.
Expected<OffsetCalibration> solve_tag(const RobotArguments& arguments, const Rig& rig,
                                      const CameraSetup& camera, const RobotSetup& robot,
                                      Output& output) {
  const auto named = [](Error error, const std::string& video) {
    if (error.where.empty()) error.where = video;
    return Unexpected(std::move(error));
  };
  const auto spin = tag_path(arguments.spin, rig, camera, robot, output);
  if (!spin) return named(spin.error(), arguments.spin);
  auto calibration = solve_offset(*spin);
  if (!calibration) return named(calibration.error(), arguments.spin);
  calibration->robot = robot.name;
  calibration->tag = robot.tag;
  calibration->edge_m = robot.edge_m;
  calibration->height_m = robot.height_m;
  if (arguments.straight.empty()) return calibration;
  const auto straight = tag_path(arguments.straight, rig, camera, robot, output);
  if (!straight) return named(straight.error(), arguments.straight);
  const auto travel = solve_yaw(*straight, calibration->offset, arguments.reverse);
  if (!travel) return named(travel.error(), arguments.straight);
  calibration->offset.yaw_rad = travel->yaw_rad;
  calibration->has_yaw = true;
  return calibration;
}

/// Calibrates all tags of a robot from the same films.
Expected<OffsetCalibration> solve(const RobotArguments& arguments, const Rig& rig,
                                  const CameraSetup& camera, const RobotSetup& robot,
                                  Output& output) {
  auto calibration = solve_tag(arguments, rig, camera, robot, output);
  for (const RobotSetup& tag : robot.more_tags) {
    if (!calibration) return calibration;
    auto more = solve_tag(arguments, rig, camera, tag, output);
    if (!more) return more;
    calibration->more_tags.push_back(std::move(*more));
  }
  return calibration;
}

/// Gives all tags of the robot the same date.
void date(OffsetCalibration& calibration) {
  calibration.made = utc_now();
  for (OffsetCalibration& tag : calibration.more_tags)
    tag.made = calibration.made;
}

ExitCode run(const RobotArguments& arguments, Output& output) {
  if (arguments.reverse && arguments.straight.empty()) {
    return fail(output, ExitCode::Usage, "--reverse applies to a straight run: --straight VIDEO");
  }
  const auto rig = read_rig(arguments.arena);
  if (!rig) return fail_all(output, rig.error());
  const auto camera = camera_of(*rig, arguments.camera);
  if (!camera) return fail_all(output, {camera.error()});
  if (const auto misfits = misfits_of_place(*rig, *camera); !misfits.empty())
    return fail_all(output, misfits);
  const auto robot = robot_of(*rig, arguments.robot);
  if (!robot) return fail_all(output, {robot.error()});
  if (robot->offset_file.empty() && arguments.file.empty()) {
    return fail_all(output,
                    {error_of(IssueCode::Config,
                              "robot \"" + robot->name +
                                  "\" names no `offset` file; add one, such as offset = \"" +
                                  robot->name + ".offset.toml\", or use -o FILE",
                              rig->file)});
  }
  const auto kind = find_robot(arguments.kind, {});
  if (!kind) return fail(output, ExitCode::Usage, kind.error().front());
  OffsetLimits limits;
  limits.most_offset_m = most_offset_of(kind->body.outline);
  if (!robot->more_tags.empty() && arguments.straight.empty()) {
    return fail(output, ExitCode::Usage,
                "robot \"" + robot->name + "\" has " + tags_text(*robot) +
                    ", which must agree on its heading: film a straight run, --straight VIDEO");
  }
  const std::string made = beside(arguments.arena, robot->offset_file);
  const std::string file = arguments.file.empty() ? made : arguments.file;
  if (const auto flaw = flaw_of_calibration_output(file, CalibrationKind::Offset, robot->name))
    return fail(output, exit_code_of_tracking(*flaw), *flaw);
  auto calibration = solve(arguments, *rig, *camera, *robot, output);
  if (!calibration) return fail_all(output, {calibration.error()});
  date(*calibration);
  if (!output.json) output.out << report_text(*calibration);
  for (const OffsetCalibration& tag : calibration->more_tags) {
    if (!output.json) output.out << report_text(tag);
  }
  std::vector<Error> faults = faults_of(*calibration, limits);
  for (Error& fault : faults)
    fault.where = arguments.spin;
  if (!faults.empty()) return fail_all(output, faults);
  if (!robot->offset_file.empty()) forget_input(made);
  if (const auto written = write_whole_file(file, calibration_text(*calibration)); !written)
    return fail(output, ExitCode::Failed, written.error());
  if (output.json) {
    JsonObject answer = offset_json(*calibration, file);
    std::vector<JsonObject> more;
    for (const OffsetCalibration& tag : calibration->more_tags)
      more.push_back(offset_json(tag, file));
    if (!more.empty()) answer.add("more_tags", more);
    output.out << answer.text() << "\n";
  }
  print_cautions(output, cautions_of(*calibration));
  print_note(output, "wrote " + file);
  return ExitCode::Done;
}

}  // namespace

CommandRun declare_calibrate_robot(Options& options) {
  auto arguments = std::make_shared<RobotArguments>();
  options.text("NAME", arguments->robot, "The robot, as the arena file names it",
               Options::Need::Required);
  options.text(
      "--kind ROBOT|FILE", arguments->kind,
      "Kind of robot: rvr, epuck, or a robot's file; its tag sits on its body (default rvr)");
  options.text("--spin FILE", arguments->spin, "Video of the robot turning on the spot, two turns",
               Options::Need::Required);
  options.text("--straight FILE", arguments->straight,
               "Video of it driving straight on for half a metre or more: gives its heading");
  options.flag("--reverse", arguments->reverse, "It drove backwards in --straight");
  options.text("--arena FILE", arguments->arena, "Arena file", Options::Need::Required);
  options.text("--camera CAMERA", arguments->camera, "Camera, if the arena has several");
  options.text("-o,--output FILE", arguments->file,
               "File to write (default: the robot's `offset` of the arena file)");
  return [arguments](Output& output) { return run(*arguments, output); };
}

}  // namespace swarmsmith
