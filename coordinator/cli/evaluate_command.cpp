#include <cstdio>
#include <filesystem>
#include <memory>

#include "coordinator/cli/commands.h"
#include "coordinator/cli/counter.h"
#include "coordinator/cli/design_argument.h"
#include "coordinator/cli/machine_argument.h"
#include "coordinator/cli/mean_interval.h"
#include "coordinator/cli/progress_text.h"
#include "coordinator/cli/recording.h"
#include "coordinator/cli/seeds.h"
#include "coordinator/cli/world_argument.h"
#include "sim/control/machine_text.h"
#include "sim/engine/simulate.h"
#include "sim/files/file_text.h"
#include "sim/mission/instance_csv.h"

namespace swarmsmith::cli {
namespace {

struct Arguments {
  std::string machine;
  std::string flavour;
  std::string profile;
  std::string mission;
  std::string campaign;
  std::string design;
  std::string seeds = "1-10";
  std::string starts;
  std::string patches;
  StoreArgument store;
  RecordingArguments recording;
};

/// Everything that the runs have in common.
struct Plan {
  Machine machine;
  Flavour flavour;
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

/// A candidate's method has a say in its flavour's constants; another flavour has its own.
Expected<Flavour> flavour_of(const Arguments& arguments, const NamedMachine& named) {
  const std::string name = first_of(arguments.flavour, named.flavour, "watermelon");
  const auto known = find_flavour(name);
  if (!known) return Unexpected(known.error());
  if (name != named.flavour || !named.turn_clock) return **known;
  return find_flavour(name, *named.turn_clock);
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
  return find_mission_or_complain(arguments.mission, "--mission", output);
}

/// The candidate's own profile, or what the flag says.
Expected<Profile> profile_of(const Arguments& arguments, const NamedMachine& named,
                             Output& output) {
  if (named.profile && (arguments.profile.empty() || arguments.profile == named.profile->name)) {
    return *named.profile;
  }
  const std::string word = arguments.profile.empty() ? "rvr" : arguments.profile;
  return find_profile_or_complain(word, "--profile", output);
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
  auto named = find_machine(arguments.machine, arguments.store);
  if (!named) return Unexpected(named.error());
  if (!arguments.campaign.empty()) {
    auto source = campaign_of(arguments.campaign, output);
    if (!source) return Unexpected(source.error());
    const auto design = find_design(*source, arguments.design);
    if (!design) return Unexpected(design.error());
    put_into_world(*named, *source, *design);
  }
  auto flavour = flavour_of(arguments, *named);
  if (!flavour) return bad_input(flavour.error().message, "--flavour");
  plan.flavour = std::move(*flavour);
  auto machine = parse_machine(named->text, plan.flavour);
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
void write_summary(std::ostream& out, const std::vector<double>& scores) {
  const MeanInterval summary = mean_interval(scores);
  const auto shown = [](double value) {
    char buffer[32];
    const int size = std::snprintf(buffer, sizeof buffer, "%.6g", value);
    return std::string(buffer, static_cast<std::size_t>(size));
  };
  out << "mean " << shown(summary.mean);
  if (scores.size() > 1) {
    out << "  95 % interval " << shown(summary.mean - summary.half_width) << " to "
        << shown(summary.mean + summary.half_width);
  }
  out << "  n " << scores.size() << "\n";
}

/// What a picture says of the run; a machine given as text has no name.
std::vector<std::string> details_of(const Arguments& arguments, std::int64_t seed, double score) {
  const std::size_t first = arguments.machine.find_first_not_of(' ');
  const bool is_text = arguments.machine.compare(first, 2, "--") == 0;
  const std::string name =
      is_text ? "" : std::filesystem::path(arguments.machine).filename().string();
  return {name, "seed " + std::to_string(seed), "score " + score_text(score)};
}

/// Also counts the cycles of a run that takes seconds; for others it would cost more than it says.
Recorder counted(Recorder recorder, const Mission& mission, Counter& counter) {
  constexpr std::int64_t kLongRun = 500'000;  // robots times cycles
  if (std::int64_t{mission.robots} * mission.cycles < kLongRun) return recorder;
  const Sensors sensors = recorder.sensors;
  return {[observe = std::move(recorder.observe), &mission, &counter](const Snapshot& now) {
            counter.tell(now.cycle, mission.cycles);
            if (observe) observe(now);
          },
          sensors};
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
  if (arguments.recording.any() && plan->seeds.size() > 1) {
    return fail(output, ExitCode::Usage,
                "--seeds: tables and pictures are of one run; name one seed");
  }
  auto recording = Recording::start(arguments.recording, plan->mission, plan->machine, output);
  if (!recording) return fail(output, exit_code_of_recording(recording.error()), recording.error());
  std::ostream& answer = arguments.recording.takes_standard_output() ? output.err : output.out;
  std::vector<double> scores;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    Counter counter(output, "simulated", "cycles of seed " + std::to_string(plan->seeds[i]));
    const SimulationResult result =
        simulate({.machine = plan->machine,
                  .flavour = plan->flavour,
                  .profile = plan->profile,
                  .mission = plan->mission,
                  .instance = instances[i],
                  .seed = plan->seeds[i]},
                 counted(recording->recorder(), plan->mission, counter));
    scores.push_back(result.score);
    const std::string score = json_number(result.score);
    if (output.json) {
      output.out << "{\"seed\":" << plan->seeds[i] << ",\"score\":" << score << "}\n";
    } else {
      answer << "seed " << plan->seeds[i] << "  score " << score << "\n";
    }
  }
  const auto written = recording->finish(details_of(arguments, plan->seeds.front(), scores.front()),
                                         instances.front());
  if (!written) return fail(output, ExitCode::Failed, written.error());
  if (!output.json) write_summary(answer, scores);
  return output.out.good() ? ExitCode::Done : ExitCode::Failed;
}

}  // namespace

Run declare_evaluate(Options& options) {
  auto arguments = std::make_shared<Arguments>();
  options.text("MACHINE", arguments->machine,
               "Text that begins with --nstates or --fsm-config, a file, or a candidate (c812)",
               Options::Need::Required);
  options.text("--flavour", arguments->flavour,
               "Flavour of the machine: watermelon, watermelon-argos3, chocolate (default: the "
               "candidate's, else watermelon)");
  options.text(
      "--profile", arguments->profile,
      "Simulator profile: rvr, argos3, pseudo-reality or a file (default: the candidate's, "
      "else rvr)");
  options.text(
      "--mission", arguments->mission,
      "aggregation, grid_exploration, color_selection or a file (default: the candidate's)");
  options.text("--campaign", arguments->campaign,
               "Campaign file or store that says flavour, profile and mission");
  options.text(
      "--design", arguments->design,
      "Which of the campaign's designs (default: d1, when they differ in repetition alone)");
  options.text("--seeds", arguments->seeds, "Seeds of the runs: 1-10 or 1,4,7-9 (default 1-10)");
  options.text("--starts", arguments->starts, "CSV of starting poses: seed,robot,x,y,theta");
  options.text("--patches", arguments->patches, "CSV of coloured patches: seed,x,y,color");
  arguments->store.declare(options, false);
  arguments->recording.declare(options);
  return [arguments](Output& output) { return run(*arguments, output); };
}

}  // namespace swarmsmith::cli
