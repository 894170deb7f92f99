#include <algorithm>
#include <memory>
#include <vector>

#include "cli/arguments/world_argument.h"
#include "cli/commands/assessment_text.h"
#include "cli/commands/commands.h"
#include "console/counter.h"
#include "sim/engine/fitting.h"
#include "sim/files/profile_file.h"
#include "sim/files/robot_file.h"

namespace swarmsmith::cli {
namespace {

using assessment::Report;

struct AssessArguments {
  std::string flavour = "watermelon";
  std::string profile;
  std::string robot;
};

/// The first built-in robot that fits the flavour; the RVR if none fits.
std::string robot_for(const Flavour& flavour) {
  for (const std::string& name : robot_names())
    if (!misfit(flavour, find_robot(name, {}).value())) return name;
  return rvr().name;
}

ExitCode run_assess(const AssessArguments& arguments, Output& output) {
  const auto flavour = find_flavour_or_complain(arguments.flavour, "--flavour", output);
  if (!flavour) return fail(output, ExitCode::Usage, flavour.error());
  const auto robot = find_robot_or_complain(
      arguments.robot.empty() ? robot_for(*flavour) : arguments.robot, "--robot", output);
  if (!robot) return fail(output, ExitCode::Usage, robot.error());
  const auto profile = find_profile_or_complain(
      arguments.profile.empty() ? usual_profile(*robot) : arguments.profile, "--profile", output);
  if (!profile) return fail(output, ExitCode::Usage, profile.error());
  if (const auto why = misfit(*flavour, *robot))
    return fail(output, ExitCode::Usage,
                {ErrorKind::BadInput, *why + "; give another --flavour or --robot", "--flavour"});
  if (const auto why = misfit(*profile, *robot))
    return fail(
        output, ExitCode::Usage,
        {ErrorKind::BadInput,
         *why + "; give another --profile" + profiles_text(*robot) + " or --robot", "--profile"});
  if (const auto why = assessment::too_big(*robot))
    return fail(output, ExitCode::Usage, {ErrorKind::BadInput, *why, "--robot"});
  const auto runs = [](const ModuleSpec& spec) { return !is_external(spec.module); };
  for (const auto* modules : {&flavour->behaviours, &flavour->conditions}) {
    for (const ModuleSpec& spec : *modules)
      if (!runs(spec))
        print_note(output,
                   spec.id + " is external: only other programs run it, so it cannot be assessed");
  }
  if (std::ranges::none_of(flavour->behaviours, runs) &&
      std::ranges::none_of(flavour->conditions, runs)) {
    return fail(output, ExitCode::Usage,
                {ErrorKind::BadInput, "all modules of the flavour are external", "--flavour"});
  }
  Counter counter(output, "assessed", "modules");
  const assessment::Subject subject{*flavour, *profile, *robot};
  const Report report =
      assessment::assess(subject, [&counter](int done, int of) { counter.tell(done, of); });
  output.out << (output.json ? assessment_json(report, subject) : assessment_text(report, subject));
  return report.passes() && output.out.good() ? ExitCode::Done : ExitCode::Failed;
}

}  // namespace

CommandRun declare_assess(Options& options) {
  auto arguments = std::make_shared<AssessArguments>();
  options.text("--flavour FLAVOUR|FILE", arguments->flavour,
               "Flavour of the modules (default watermelon)");
  options.text("--profile PROFILE|FILE", arguments->profile,
               "Simulator profile (default: the robot's, rvr or epuck)");
  options.text("--robot ROBOT|FILE", arguments->robot,
               "The robot (default: the first of `ls robots` that the flavour fits)");
  return [arguments](Output& output) { return run_assess(*arguments, output); };
}

}  // namespace swarmsmith::cli
