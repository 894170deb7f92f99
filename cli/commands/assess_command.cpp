#include <memory>

#include "cli/arguments/world_argument.h"
#include "cli/commands/assessment_text.h"
#include "cli/commands/commands.h"
#include "console/counter.h"
#include "sim/engine/fitting.h"

namespace swarmsmith::cli {
namespace {

using assessment::Report;

struct AssessArguments {
  std::string flavour = "watermelon";
  std::string profile = "rvr";
};

ExitCode run_assess(const AssessArguments& arguments, Output& output) {
  const auto flavour = find_flavour_or_complain(arguments.flavour, "--flavour", output);
  if (!flavour) return fail(output, ExitCode::Usage, flavour.error());
  const auto profile = find_profile_or_complain(arguments.profile, "--profile", output);
  if (!profile) return fail(output, ExitCode::Usage, profile.error());
  // What modules promise is checked with RVRs.
  if (const auto why = misfit(*flavour, rvr()))
    return fail(output, ExitCode::Usage, {ErrorKind::BadInput, *why, "--flavour"});
  if (const auto why = misfit(*profile, rvr()))
    return fail(output, ExitCode::Usage, {ErrorKind::BadInput, *why, "--profile"});
  Counter counter(output, "assessed", "modules");
  const Report report = assessment::assess(
      *flavour, *profile, [&counter](int done, int of) { counter.tell(done, of); });
  output.out << (output.json ? assessment_json(report, flavour->name, profile->name)
                             : assessment_text(report, flavour->name, profile->name));
  return report.passes() && output.out.good() ? ExitCode::Done : ExitCode::Failed;
}

}  // namespace

CommandRun declare_assess(Options& options) {
  auto arguments = std::make_shared<AssessArguments>();
  options.text("--flavour FLAVOUR|FILE", arguments->flavour,
               "Flavour of the modules (default watermelon)");
  options.text("--profile PROFILE|FILE", arguments->profile, "Simulator profile (default rvr)");
  return [arguments](Output& output) { return run_assess(*arguments, output); };
}

}  // namespace swarmsmith::cli
