#include <cstdio>
#include <memory>

#include "coordinator/cli/commands.h"
#include "coordinator/cli/machine_argument.h"
#include "coordinator/cli/mean_interval.h"
#include "coordinator/cli/seeds.h"
#include "sim/control/machine_text.h"
#include "sim/engine/simulate.h"
#include "sim/files/file_text.h"
#include "sim/files/mission_file.h"
#include "sim/files/profile_file.h"
#include "sim/mission/instance_csv.h"

namespace swarmsmith::cli {
namespace {

struct Arguments {
  std::string machine;
  std::string flavour;
  std::string profile;
  std::string mission;
  std::string seeds = "1-10";
  std::string starts;
  std::string patches;
  StoreArgument store;
};

/// Everything that the runs have in common.
struct Plan {
  Machine machine;
  const Flavour* flavour = nullptr;
  Profile profile;
  Mission mission;
  std::vector<std::int64_t> seeds;
  ExplicitInstances given;
};

/// The first text that is not empty.
std::string first_of(const std::string& a, const std::string& b, const std::string& c) {
  if (!a.empty()) return a;
  return b.empty() ? c : b;
}

/// The last thing that is wrong; those before it are printed. What has no place of its own is the
/// flag's.
Unexpected complain(const std::vector<Error>& errors, const std::string& flag, Output& output) {
  for (std::size_t i = 0; i + 1 < errors.size(); ++i)
    print_error(output, errors[i]);
  const Error& last = errors.back();
  return bad_input(last.message, last.where.empty() ? flag : last.where);
}

/// A candidate's own mission may have been changed by its file; the flag names a built-in one, or a
/// file.
Expected<Mission> mission_of(const Arguments& arguments, const NamedMachine& named,
                             Output& output) {
  if (arguments.mission.empty()) {
    if (named.mission) return named.mission->mission;
    return bad_input(
        "on which mission? Add --mission aggregation, grid_exploration, color_selection or a file",
        "--mission");
  }
  if (named.mission && named.mission->mission.name == arguments.mission) {
    return named.mission->mission;
  }
  auto found = find_mission(arguments.mission, {});
  if (!found) return complain(found.error(), "--mission", output);
  return std::move(found->mission);
}

/// The candidate's own profile, or what the flag says.
Expected<Profile> profile_of(const Arguments& arguments, const NamedMachine& named,
                             Output& output) {
  if (named.profile && (arguments.profile.empty() || arguments.profile == named.profile->name)) {
    return *named.profile;
  }
  auto found = find_profile(arguments.profile.empty() ? "rvr" : arguments.profile, {});
  if (!found) return complain(found.error(), "--profile", output);
  return std::move(*found);
}

/// A table of a file; errors say "file:line".
template <class Table>
Expected<Table> read_table(const std::string& file, Expected<Table> (*parse)(std::string_view)) {
  const auto text = read_file(file, "table");
  if (!text) return Unexpected(text.error());
  auto table = parse(*text);
  if (table) return table;
  return bad_input(table.error().message, file + ":" + table.error().where);
}

/// The tables, where they are named.
Expected<void> read_instances(const Arguments& arguments, Plan& plan, Output& output) {
  if (!arguments.starts.empty()) {
    auto starts = read_table(arguments.starts, parse_starts_csv);
    if (!starts) return Unexpected(starts.error());
    plan.given.starts = std::move(*starts);
  }
  if (arguments.patches.empty()) return {};
  if (plan.mission.shuffled.places.empty()) {
    print_note(output,
               "mission " + plan.mission.name + " shuffles no patches: --patches is not used");
    return {};
  }
  auto patches = read_table(arguments.patches, parse_patches_csv);
  if (!patches) return Unexpected(patches.error());
  plan.given.patches = std::move(*patches);
  return {};
}

/// Everything that the command line says, read and checked.
Expected<Plan> make_plan(const Arguments& arguments, Output& output) {
  Plan plan;
  const auto named = find_machine(arguments.machine, arguments.store);
  if (!named) return Unexpected(named.error());
  const auto flavour = find_flavour(first_of(arguments.flavour, named->flavour, "watermelon"));
  if (!flavour) return bad_input(flavour.error().message, "--flavour");
  plan.flavour = *flavour;
  auto machine = parse_machine(named->text, **flavour);
  if (!machine) return bad_input(machine.error().message, "MACHINE, " + machine.error().where);
  plan.machine = std::move(*machine);
  auto profile = profile_of(arguments, *named, output);
  if (!profile) return Unexpected(profile.error());
  plan.profile = std::move(*profile);
  auto mission = mission_of(arguments, *named, output);
  if (!mission) return Unexpected(mission.error());
  plan.mission = std::move(*mission);
  auto seeds = parse_seeds(arguments.seeds);
  if (!seeds) return Unexpected(seeds.error());
  plan.seeds = std::move(*seeds);
  if (auto read = read_instances(arguments, plan, output); !read) return Unexpected(read.error());
  return plan;
}

/// For people: mean and interval.
void write_summary(Output& output, const std::vector<double>& scores) {
  const MeanInterval summary = mean_interval(scores);
  const auto shown = [](double value) {
    char buffer[32];
    const int size = std::snprintf(buffer, sizeof buffer, "%.6g", value);
    return std::string(buffer, static_cast<std::size_t>(size));
  };
  output.out << "mean " << shown(summary.mean);
  if (scores.size() > 1) {
    output.out << "  95 % interval " << shown(summary.mean - summary.half_width) << " to "
               << shown(summary.mean + summary.half_width);
  }
  output.out << "  n " << scores.size() << "\n";
}

ExitCode run(const Arguments& arguments, Output& output) {
  const auto plan = make_plan(arguments, output);
  if (!plan) {
    const Error& error = plan.error();
    const bool no_candidate = error.kind == ErrorKind::NotFound && error.where.empty();
    const bool no_store = error.kind != ErrorKind::BadInput && !no_candidate;
    const bool of_files = error.where == arguments.starts || error.where == arguments.patches;
    if (no_store && !of_files) return fail(output, ExitCode::Store, error);
    return fail(output, no_candidate ? ExitCode::NoSuchId : ExitCode::Usage, error);
  }
  // All instances first, so that a missing row stops everything and not the second half.
  std::vector<Instance> instances;
  for (const std::int64_t seed : plan->seeds) {
    auto instance = instance_of(plan->mission, seed, plan->given);
    if (!instance) return fail(output, ExitCode::Usage, instance.error());
    instances.push_back(std::move(*instance));
  }
  std::vector<double> scores;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const SimulationResult result = simulate({.machine = plan->machine,
                                              .flavour = *plan->flavour,
                                              .profile = plan->profile,
                                              .mission = plan->mission,
                                              .instance = instances[i],
                                              .seed = plan->seeds[i]});
    scores.push_back(result.score);
    const std::string score = json_number(result.score);
    if (output.json) {
      output.out << "{\"seed\":" << plan->seeds[i] << ",\"score\":" << score << "}\n";
    } else {
      output.out << "seed " << plan->seeds[i] << "  score " << score << "\n";
    }
  }
  if (!output.json) write_summary(output, scores);
  return output.out.good() ? ExitCode::Done : ExitCode::Failed;
}

}  // namespace

Run declare_evaluate(Options& options) {
  auto arguments = std::make_shared<Arguments>();
  options.text("MACHINE", arguments->machine,
               "Text that begins with --nstates or --fsm-config, a file, or a candidate (c812)",
               Options::Need::Required);
  options.text("--flavour", arguments->flavour,
               "Flavour of the machine (default: the candidate's, else watermelon)");
  options.text(
      "--profile", arguments->profile,
      "Simulator profile: rvr, argos3, pseudo-reality or a file (default: the candidate's, "
      "else rvr)");
  options.text(
      "--mission", arguments->mission,
      "aggregation, grid_exploration, color_selection or a file (default: the candidate's)");
  options.text("--seeds", arguments->seeds, "Seeds of the runs: 1-10 or 1,4,7-9 (default 1-10)");
  options.text("--starts", arguments->starts, "CSV of starting poses: seed,robot,x,y,theta");
  options.text("--patches", arguments->patches, "CSV of coloured patches: seed,x,y,color");
  arguments->store.declare(options, false);
  return [arguments](Output& output) { return run(*arguments, output); };
}

}  // namespace swarmsmith::cli
