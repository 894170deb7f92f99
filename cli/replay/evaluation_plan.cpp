#include "cli/replay/evaluation_plan.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <set>
#include <utility>

#include "base/plain_text.h"
#include "base/rng.h"
#include "base/suggestion.h"
#include "base/text/whole_file.h"
#include "cli/arguments/thing_id.h"
#include "cli/arguments/world_argument.h"
#include "cli/output/query_output.h"
#include "cli/replay/design_argument.h"
#include "cli/replay/design_worlds.h"
#include "console/seeds.h"
#include "coordinator/campaign/campaign_file.h"
#include "sim/control/controller.h"
#include "sim/control/flavour_file.h"
#include "sim/control/foreign_text.h"
#include "sim/engine/fitting.h"
#include "sim/files/mission_file.h"
#include "sim/files/profile_file.h"
#include "sim/mission/instance_csv.h"

namespace swarmsmith::cli {
namespace {

constexpr std::int64_t kLargestSeed = 2'147'483'647;
constexpr const char* kTurnClock = "--turn-clock";

/// The flavour is never guessed, because the same text is a different machine under another
/// flavour. A candidate's method may change constants of its flavour; another flavour has its own
/// constants.
Expected<Flavour> flavour_of(const EvaluateArguments& arguments, const NamedMachine& named,
                             Output& output) {
  std::string name = named.flavour;
  const Flavour* own = named.own_flavour;
  if (!arguments.flavour.empty() && arguments.flavour != named.flavour) {
    auto given = find_flavour_or_complain(arguments.flavour, "--flavour", output);
    if (!given) return Unexpected(given.error());
    name = given->name;
    own = kept_flavour(std::move(*given));
  }
  if (name.empty()) {
    return bad_input("the machine's flavour is unknown; add --flavour with one of " +
                     joined(flavour_names()) +
                     ", or a file; files that `swarmsmith export` writes name it");
  }
  const bool is_other = name != named.flavour || own != named.own_flavour;
  if (!named.candidate && !named.flavour.empty() && is_other) {
    return bad_input("the machine is of the flavour " + named.flavour + " (" + named.place +
                     "), not " + arguments.flavour +
                     "; leave the flag out, or change the file's head");
  }
  const auto known = find_flavour(name, own);
  if (!known) return Unexpected(known.error());
  std::optional<TurnClock> clock;
  if (name == named.flavour) clock = named.turn_clock;
  if (name == named.flavour && named.candidate && !clock) clock = (**known).exploration.turn_clock;
  if (!arguments.turn_clock.empty()) {
    const TurnClock wanted = arguments.turn_clock == name_of(TurnClock::Seconds)
                                 ? TurnClock::Seconds
                                 : TurnClock::Cycles;
    if (clock && wanted != *clock) {
      return bad_input("the machine was designed with the turn clock " +
                           std::string(name_of(*clock)) + "; leave the flag out",
                       kTurnClock);
    }
    clock = wanted;
  }
  if (!clock) return **known;
  return find_flavour(name, *clock, own);
}

/// By default the candidate's own mission, which its file may have changed; the flag names a
/// built-in mission or a file.
Expected<Mission> mission_of(const EvaluateArguments& arguments, const NamedMachine& named,
                             Output& output) {
  if (arguments.mission.empty()) {
    if (named.mission) return named.mission->mission;
    return bad_input("no mission given; add --mission " + joined(mission_names()) + " or a file",
                     "--mission");
  }
  if (named.mission && named.mission->mission.name == arguments.mission) {
    return named.mission->mission;
  }
  return find_mission_or_complain(arguments.mission, "--mission", output);
}

/// The candidate's own profile, or the one of the flag; without both, that of the mission's robot.
Expected<Profile> profile_of(const EvaluateArguments& arguments, const NamedMachine& named,
                             const Robot& robot, Output& output) {
  if (named.profile && (arguments.profile.empty() || arguments.profile == named.profile->name)) {
    return *named.profile;
  }
  const std::string word = arguments.profile.empty() ? usual_profile(robot) : arguments.profile;
  return find_profile_or_complain(word, "--profile", output);
}

/// Reads a table from a file; errors have the place "file:line".
template <class Table>
Expected<Table> read_table(const std::string& file, Expected<Table> (*parse)(std::string_view)) {
  const auto text = read_file(file, "table");
  if (!text) return bad_input(text.error().message, text.error().where);
  auto table = parse(*text);
  if (table) return table;
  return bad_input(table.error().message, file + ":" + table.error().where);
}

/// The tables of starts and patches, if the arguments name them; patches only if a job's mission
/// shuffles some.
Expected<ExplicitInstances> read_instances(const EvaluateArguments& arguments,
                                           const std::vector<EvaluationJob>& jobs, Output& output) {
  ExplicitInstances given;
  if (!arguments.starts.empty()) {
    auto starts = read_table(arguments.starts, parse_starts_csv);
    if (!starts) return Unexpected(starts.error());
    given.starts = std::move(*starts);
  }
  if (arguments.patches.empty()) return given;
  const auto shuffles = [](const EvaluationJob& job) {
    return !job.mission.shuffled.places.empty();
  };
  if (std::ranges::none_of(jobs, shuffles)) {
    print_note(output, "mission " + jobs.front().mission.name +
                           " shuffles no patches: --patches is not used");
    return given;
  }
  auto patches = read_table(arguments.patches, parse_patches_csv);
  if (!patches) return Unexpected(patches.error());
  given.patches = std::move(*patches);
  return given;
}

/// The winners of all finished designs, or of the named designs.
Expected<std::vector<NamedMachine>> winners_of(const EvaluateArguments& arguments) {
  const auto store = arguments.store.open();
  if (!store) return Unexpected(store.error());
  const auto worlds = DesignWorlds::read(**store);
  if (!worlds) return Unexpected(worlds.error());
  std::vector<NamedMachine> machines;
  for (const std::string& word : arguments.designs) {
    const auto is_it = [&](const KnownDesign& design) { return to_string(design.id) == word; };
    const auto found = std::ranges::find_if(worlds->designs(), is_it);
    if (found == worlds->designs().end()) {
      return unexpected(ErrorKind::NotFound, "the store has no design " + word);
    }
    if (!found->finished || !found->best) {
      return bad_input("it is not finished; its candidates can be named (c812)", word);
    }
  }
  for (const KnownDesign& design : worlds->designs()) {
    const auto& wanted = arguments.designs;
    const bool is_named = std::ranges::find(wanted, to_string(design.id)) != wanted.end();
    if (!wanted.empty() && !is_named) continue;
    if (!design.finished || !design.best) continue;
    auto machine = machine_of_candidate(**store, *worlds, design.best);
    if (!machine) return Unexpected(machine.error());
    machines.push_back(std::move(*machine));
  }
  if (machines.empty()) return bad_input("no design of the store is finished yet", "best");
  return machines;
}

/// The machines that the argument MACHINE names, with their simulation settings.
Expected<std::vector<NamedMachine>> machines_of(const EvaluateArguments& arguments,
                                                Output& output) {
  const auto id = parse_thing_id(arguments.machine);
  const bool of_store = arguments.machine == "best" || (id && id->letter == 'c');
  if (!of_store && !arguments.store.word.empty()) {
    return bad_input("unexpected word `" + arguments.store.word +
                     "`: a store is only for a candidate (c812) or `best`");
  }
  if (arguments.machine == "best") {
    if (arguments.campaign.empty()) return winners_of(arguments);
    return bad_input("the winners have campaigns of their own", "--campaign");
  }
  auto machines = find_machines(arguments.machine, arguments.store, output);
  if (!machines) return Unexpected(machines.error());
  if (arguments.designs.size() > 1) {
    return bad_input("is one design here; only with `best` may it be given more than once",
                     "--design");
  }
  if (!arguments.campaign.empty()) {
    auto source = campaign_of(arguments.campaign, output);
    if (!source) return Unexpected(source.error());
    const auto design =
        find_design(*source, arguments.designs.empty() ? "" : arguments.designs.front());
    if (!design) return Unexpected(design.error());
    for (NamedMachine& named : *machines) {
      const std::string said = named.candidate ? "" : named.flavour;
      put_into_world(named, *source, *design);
      if (said.empty() || said == named.flavour) continue;
      return bad_input(
          "the machine is of the flavour " + said + ", the campaign's design of " + named.flavour,
          named.place);
    }
  }
  return machines;
}

Expected<EvaluationJob> job_of(const NamedMachine& named, const EvaluateArguments& arguments,
                               Output& output) {
  EvaluationJob job{.candidate = named.candidate, .name = named.name};
  std::string where = named.candidate ? to_string(named.candidate) : named.place;
  if (where.empty()) where = "MACHINE";
  auto flavour = flavour_of(arguments, named, output);
  if (!flavour) {
    const Error& error = flavour.error();
    return bad_input(error.message, error.where.empty() ? "--flavour" : error.where);
  }
  job.flavour = std::move(*flavour);
  auto controller = parse_controller(named.text, job.flavour);
  if (!controller)
    return bad_input(controller.error().message, where + ", " + controller.error().where);
  if (const auto complaint = complaint_about_running(*controller, job.flavour))
    return bad_input(*complaint, where);
  job.controller = std::move(*controller);
  auto mission = mission_of(arguments, named, output);
  if (!mission) return Unexpected(mission.error());
  job.mission = std::move(*mission);
  const Robot& robot = job.mission.robot;
  auto profile = profile_of(arguments, named, robot, output);
  if (!profile) return Unexpected(profile.error());
  job.profile = std::move(*profile);
  const std::string other = ", or a --mission of another robot";
  if (const auto why = misfit(job.flavour, robot))
    return bad_input(*why + "; give another --flavour" + other, "--flavour");
  if (const auto why = misfit(job.profile, robot))
    return bad_input(*why + "; give another --profile" + profiles_text(robot) + other, "--profile");
  const auto* network = std::get_if<Network>(&job.controller);
  if (const auto why = network != nullptr ? misfit(network->inputs, robot) : std::nullopt)
    return bad_input(*why + "; give another machine" + other, where);
  return job;
}

/// The profile with this name in the store, or else in this program.
std::optional<Profile> known_profile(const NamedMachine& named, const std::string& name) {
  if (named.profile && named.profile->name == name) return named.profile;
  const auto further = std::ranges::find(named.further_profiles, name, &Profile::name);
  if (further != named.further_profiles.end()) return *further;
  auto built_in = built_in_profile(name);
  return built_in ? std::optional(std::move(*built_in)) : std::nullopt;
}

/// The reason why the job's scores do not belong to the design; nothing if they do.
std::optional<std::string> complaint_about(const EvaluationJob& job, const NamedMachine& named,
                                           const EvaluateArguments& arguments) {
  if (!arguments.starts.empty() || !arguments.patches.empty()) {
    return "a stored score follows from its seed, and not from tables of starts or patches";
  }
  if (!arguments.campaign.empty()) return "the candidate has a campaign of its own";
  if (!arguments.flavour.empty() && arguments.flavour != named.flavour) {
    return "the design's machines are of the flavour " + named.flavour;
  }
  const bool same_mission = named.mission ? named.mission->mission == job.mission
                                          : named.design_mission == job.mission.name;
  if (!same_mission) return "the design is one for the mission " + named.design_mission;
  const std::string& name = job.profile.name;
  if (auto why = complaint_about_source(name)) return why;
  const auto known = known_profile(named, name);
  if (known && *known != job.profile) {
    return "there is another profile " + name +
           ", whose scores would be mixed up with these; give it another name";
  }
  return std::nullopt;
}

/// The given seeds, or the default: a fresh seed for a store's candidates; for a file the seeds in
/// its head, else 1-10.
Expected<std::vector<std::int64_t>> seeds_of(const EvaluateArguments& arguments,
                                             const NamedMachine& named) {
  if (!arguments.seeds.empty()) return parse_seeds(arguments.seeds);
  if (!named.seeds.empty()) {
    auto seeds = parse_seeds(named.seeds);
    if (!seeds) return bad_input(seeds.error().message, named.place + ", `seeds` of its head");
    return seeds;
  }
  if (!named.candidate) return parse_seeds("1-10");
  const auto store = arguments.store.open();
  if (!store) return Unexpected(store.error());
  const auto seed = fresh_seed(**store, static_cast<std::uint64_t>((*store)->campaign().seed));
  if (!seed) return Unexpected(seed.error());
  return std::vector{*seed};
}

/// Makes all instances first, so that a missing row is found before anything is simulated. Given
/// starts may overlap, as those of other simulators do; a note says so.
Expected<void> add_instances(EvaluationPlan& plan, const ExplicitInstances& given, Output& output) {
  std::set<std::int64_t> seeds;
  std::set<std::int64_t> overlapping;
  for (EvaluationJob& job : plan.jobs) {
    for (const std::int64_t seed : job.seeds) {
      auto instance = instance_of(job.mission, seed, given);
      if (!instance) return bad_input(instance.error().message, instance.error().where);
      seeds.insert(seed);
      if (given.starts && has_overlaps(job.mission, *instance)) overlapping.insert(seed);
      job.instances.push_back(std::move(*instance));
    }
  }
  if (overlapping.empty()) return {};
  print_note(output, "note: in the starts of " + std::to_string(overlapping.size()) + " of " +
                         counted(seeds.size(), "seed") +
                         ", robots overlap each other, a wall or something in the arena (seed " +
                         std::to_string(*overlapping.begin()) + ")");
  return {};
}

}  // namespace

Expected<EvaluationPlan> plan_evaluations(const EvaluateArguments& arguments, Output& output) {
  EvaluationPlan plan;
  const auto machines = machines_of(arguments, output);
  if (!machines) return Unexpected(machines.error());
  const bool is_text = arguments.machine.find("--") == arguments.machine.find_first_not_of(' ');
  if (!is_text) plan.machine = std::filesystem::path(arguments.machine).filename().string();
  if (machines->front().candidate && !arguments.no_store) plan.store = *arguments.store.path();
  for (const NamedMachine& named : *machines) {
    auto job = job_of(named, arguments, output);
    if (!job) return Unexpected(job.error());
    if (!plan.store.empty()) {
      if (auto complaint = complaint_about(*job, named, arguments)) {
        return bad_input(*complaint + "; --no-store prints them only", to_string(named.candidate));
      }
      job->keeps_profile = !known_profile(named, job->profile.name);
    }
    // All candidates get the same fresh seed, because their scores are compared.
    auto seeds = named.candidate && !plan.jobs.empty()
                     ? Expected<std::vector<std::int64_t>>(plan.jobs.front().seeds)
                     : seeds_of(arguments, named);
    if (!seeds) return Unexpected(seeds.error());
    job->seeds = std::move(*seeds);
    plan.jobs.push_back(std::move(*job));
  }
  for (const NamedMachine& named : *machines) {
    const auto remark = remark_about(named.text);
    if (!remark) continue;
    print_note(output, named.place + ": " + *remark);
    break;
  }
  const auto given = read_instances(arguments, plan.jobs, output);
  if (!given) return Unexpected(given.error());
  if (auto added = add_instances(plan, *given, output); !added) return Unexpected(added.error());
  return plan;
}

Expected<std::int64_t> fresh_seed(StoreReader& store, std::uint64_t campaign_seed) {
  constexpr std::int64_t kAll = std::numeric_limits<std::int64_t>::max();
  // Seeds of later scores do not count as used, so every call gives the same seed
  // (docs/command-line.md, `evaluate`).
  const auto rows =
      select(store, "SELECT DISTINCT seed FROM v_evaluations WHERE purpose <> 'score' AND seed > 0",
             {.rows = kAll, .seconds = 600, .bytes = kAll});
  if (!rows) return Unexpected(rows.error());
  std::set<std::string> used;
  for (const auto& cells : rows->cells)
    used.insert(cells.front().text);
  Rng stream = Rng(campaign_seed).split("score");
  std::int64_t seed = stream.uniform_int(1, kLargestSeed);
  while (used.contains(std::to_string(seed)))
    seed = stream.uniform_int(1, kLargestSeed);
  return seed;
}

}  // namespace swarmsmith::cli
