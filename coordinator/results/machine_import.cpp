#include "coordinator/results/machine_import.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/hash.h"
#include "base/suggestion.h"
#include "base/text/json.h"
#include "coordinator/campaign/method_space.h"
#include "sim/control/controller.h"
#include "sim/control/flavour_file.h"
#include "sim/files/machine_file.h"
#include "sim/files/mission_file.h"
#include "sim/files/profile_file.h"

namespace swarmsmith {
namespace {

/// The first of these columns that the table has; none if it has none.
std::optional<std::string> first_column(const CsvTable& table,
                                        std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (table.column(name)) return name;
  }
  return std::nullopt;
}

std::optional<std::string> machine_column(const CsvTable& table) {
  return first_column(table, {"fsm", "fsm_config", "machine"});
}

/// Counts the repetitions of each mission and method.
class Repetitions {
 public:
  explicit Repetitions(const std::vector<KnownDesign>& known) {
    for (const KnownDesign& design : known) {
      std::int64_t& last = last_[{design.mission, design.method}];
      last = std::max(last, design.repetition);
    }
  }
  std::int64_t next(const std::string& mission, const std::string& method) {
    return ++last_[{mission, method}];
  }

 private:
  std::map<std::pair<std::string, std::string>, std::int64_t> last_;
};

/// The error in a design's mission or method, if there is one.
std::optional<std::string> complaint_about(const std::string& mission, const std::string& method,
                                           bool is_known) {
  if (mission.empty()) {
    return "no mission is named; add a column mission, or --mission aggregation";
  }
  if (!is_name(mission)) {
    return "`" + mission +
           "` is not a valid mission name (letters, digits, _ - .); rename it with --mission "
           "OLD=NEW";
  }
  if (!is_known) {
    constexpr std::array<const char*, 3> kBuiltIn{"aggregation", "grid_exploration",
                                                  "color_selection"};
    const auto* const meant = std::ranges::find_if(
        kBuiltIn, [&](const std::string& name) { return name.starts_with(mission); });
    return meant == kBuiltIn.end()
               ? fmt::format(
                     "there is no mission `{0}` here; say which one it is: --mission {0}=NEW, "
                     "or --mission {0}={0} to keep the name",
                     mission)
               : fmt::format(
                     "there is no mission `{0}` here; is it {1}? Then --mission {0}={1}, "
                     "or --mission {0}={0} to keep the name",
                     mission, *meant);
  }
  if (!is_name(method)) {
    return "`" + method + "` is not a valid method name (letters, digits, _ - .)";
  }
  return std::nullopt;
}

/// Collects the worlds of all machines: one mission per name, and one profile.
class Worlds {
 public:
  /// The description of the machine's mission, here called `name`; none if the name is enough.
  static std::optional<MissionEntry> entry_of(const MachineText& from, const std::string& name,
                                              const MissionWords& words) {
    if (const MissionEntry* of_file = words.of_file(name)) return *of_file;
    const auto built_in = built_in_mission(name);
    // A mission that is renamed to a built-in one becomes the built-in one.
    if (!from.described || (built_in && from.mission != name)) return std::nullopt;
    MissionEntry entry = *from.described;
    entry.mission.name = name;
    if (built_in && *built_in == entry.mission) return std::nullopt;
    return entry;
  }

  /// Returns an error if the machine's mission or profile differs from earlier ones.
  std::optional<std::string> add(const MachineText& from, const std::string& name,
                                 const MissionWords& words) {
    auto entry = entry_of(from, name, words);
    const auto [known, is_new] = missions_.try_emplace(name, std::move(entry));
    if (!is_new && known->second != entry) {
      return "a machine before it has another mission " + name +
             "; import a file for each, or rename with --mission OLD=NEW";
    }
    if (!from.profile) return std::nullopt;
    if (profile_ && *profile_ != *from.profile) {
      return "the machine is for the profile " + from.profile->name + ", one before it for " +
             (profile_->name == from.profile->name ? "another of this name" : profile_->name) +
             "; import a file for each";
    }
    profile_ = from.profile;
    return std::nullopt;
  }

  /// The parts that are not built in: without a profile, machines are simulated with that
  /// of their robot, `rvr` for the RVR.
  ImportedWorld world() const {
    ImportedWorld world;
    for (const auto& [name, entry] : missions_) {
      if (entry) world.missions.push_back(*entry);
    }
    const auto usual = built_in_profile("rvr");
    if (profile_ && !(usual && *usual == *profile_)) world.profile = profile_;
    return world;
  }

 private:
  std::map<std::string, std::optional<MissionEntry>> missions_;  ///< by name here
  std::optional<Profile> profile_;
};

/// The error if a mission file is given for all machines but the machines name two missions.
std::optional<Error> complaint_about_two(const std::vector<MachineText>& machines,
                                         const MissionWords& words) {
  if (!words.all_of_file) return std::nullopt;
  std::string first;
  for (const MachineText& from : machines) {
    if (from.mission.empty() || words.renamed.contains(from.mission)) continue;
    if (first.empty()) first = from.mission;
    if (from.mission == first) continue;
    return Error{ErrorKind::BadInput,
                 "the file has the missions " + first + " and " + from.mission +
                     "; name a mission file for each: --mission OLD=FILE",
                 from.place};
  }
  return std::nullopt;
}

/// In the form of a campaign's row: TOML texts in JSON.
std::string deciding_json(const MachineImport& known, std::size_t machines,
                          const ImportedWorld& world) {
  JsonObject object;
  object.add("imported", "machines")
      .add("flavour", known.flavour.name)
      .add("machines", std::to_string(machines));
  for (const Section& section : imported_sections(world)) {
    for (const SectionLine& line : section.lines)
      object.add(section.prefix + line.key, line.value);
  }
  return object.text();
}

void add_design(Addition& addition, DesignRow design, const MachineText& from,
                const Controller& controller, const Flavour& flavour) {
  CandidateText text = text_of(controller, flavour);
  const CandidateId winner = candidate_id(design.id, 1);
  addition.rows.emplace_back(CandidateRow{.id = winner,
                                          .iteration = 0,
                                          .parent = {},
                                          .parameters = std::move(text.parameters),
                                          .machine = std::move(text.machine),
                                          .modules = std::move(text.modules),
                                          .states = text.states,
                                          .transitions = text.transitions});
  addition.rows.emplace_back(DesignStateRow{.design = design.id,
                                            .state = DesignState::Finished,
                                            .used = 0,
                                            .iteration = 0,
                                            .best = winner,
                                            .best_mean = 0,
                                            .reason = "imported"});
  addition.designs.push_back({std::move(design), from.name});
}

}  // namespace

OrErrors<std::vector<MachineText>> read_machine_lines(std::string_view text,
                                                      const std::string& file) {
  auto filed = parse_machine_file(text, file);
  if (!filed) return tl::unexpected(std::move(filed.error()));
  std::vector<MachineText> machines;
  std::vector<Error> errors;
  for (FiledMachine& from : *filed) {
    MachineHead& head = from.head;
    const auto flavour = find_flavour(head.flavour, head.own_flavour);
    if (flavour && head.turn_clock && *head.turn_clock != (*flavour)->exploration.turn_clock) {
      errors.push_back(
          {ErrorKind::BadInput,
           "its turn clock is not that of its flavour, and a store of imported machines "
           "keeps flavours only; `swarmsmith evaluate` takes the file",
           from.place});
    }
    machines.push_back({.name = std::move(from.name),
                        .mission = head.mission ? head.mission->mission.name : "",
                        .method = std::move(head.method),
                        .flavour = std::move(head.flavour),
                        .own_flavour = head.own_flavour,
                        .text = std::move(from.text),
                        .place = std::move(from.place),
                        .described = std::move(head.mission),
                        .profile = std::move(head.profile)});
  }
  if (!errors.empty()) return tl::unexpected(std::move(errors));
  return machines;
}

bool has_machines(const CsvTable& table) {
  return machine_column(table).has_value();
}

OrErrors<std::vector<MachineText>> read_machine_table(const CsvTable& table) {
  const auto machine = machine_column(table);
  if (!machine || table.rows.empty()) {
    return tl::unexpected(std::vector{
        Error{ErrorKind::BadInput,
              machine ? "the table has no rows" : "there is no column fsm, fsm_config or machine",
              table.file}});
  }
  const std::string name = first_column(table, {"fsm_id", "name"}).value_or("");
  std::vector<MachineText> machines;
  for (const CsvRow& row : table.rows) {
    machines.push_back({.name = cell_of(table, row, name),
                        .mission = cell_of(table, row, "mission"),
                        .method = cell_of(table, row, "method"),
                        .flavour = cell_of(table, row, "flavour"),
                        .text = cell_of(table, row, *machine),
                        .place = table.place(row),
                        .described = {},
                        .profile = {}});
  }
  return machines;
}

Expected<Flavour> flavour_of(const std::vector<MachineText>& machines,
                             const std::optional<Flavour>& said) {
  std::optional<Flavour> flavour = said;
  for (const MachineText& machine : machines) {
    // A table contains only the name of a flavour that a file describes.
    const bool is_named =
        machine.own_flavour == nullptr && flavour && machine.flavour == flavour->name;
    if (machine.flavour.empty() || is_named) continue;
    const auto its = find_flavour(machine.flavour, machine.own_flavour);
    if (!its) return unexpected(its.error().kind, its.error().message, machine.place);
    if (!flavour) flavour = **its;
    if (*flavour == **its) continue;
    const std::string other =
        flavour->name == machine.flavour ? "another of this name" : flavour->name;
    return bad_input(said ? "the machine is of the flavour " + machine.flavour + ", not " + other +
                                "; leave --flavour out"
                          : "the machine is of the flavour " + machine.flavour +
                                ", one before it of " + other + "; import a file for each",
                     machine.place);
  }
  const auto silent = std::ranges::find(machines, "", &MachineText::flavour);
  if (!said && silent != machines.end()) {
    return bad_input("the machine's flavour is unknown; add --flavour with one of " +
                         joined(flavour_names()) + ", or a file",
                     silent->place);
  }
  return *flavour;
}

OrErrors<Addition> import_machines(const std::vector<MachineText>& machines,
                                   const MachineImport& known) {
  std::vector<Error> errors;
  Addition addition;
  Digest digest;
  digest.add("machines");
  digest.add(known.flavour.name);
  Repetitions repetitions(known.designs);
  // Known designs are sorted by id.
  std::int64_t id = known.designs.empty() ? 0 : known.designs.back().id.value;
  std::map<std::pair<std::string, std::string>, std::string> names;
  Worlds worlds;
  if (auto error = complaint_about_two(machines, known.missions))
    errors.push_back(std::move(*error));
  for (const MachineText& from : machines) {
    const std::string mission = known.missions.name_of(from.mission);
    const std::string method = from.method.empty() ? known.method : from.method;
    // Renaming a mission to itself keeps its name.
    const bool is_known =
        from.described || known.missions.of_file(mission) != nullptr ||
        built_in_mission(mission).has_value() || known.missions.renamed.contains(from.mission) ||
        (from.mission.empty() && !known.missions.of_all.empty()) ||
        std::ranges::find(known.designs, mission, &KnownDesign::mission) != known.designs.end();
    if (auto complaint = complaint_about(mission, method, is_known)) {
      errors.push_back({ErrorKind::BadInput, std::move(*complaint), from.place});
      continue;
    }
    if (auto complaint = worlds.add(from, mission, known.missions)) {
      errors.push_back({ErrorKind::BadInput, std::move(*complaint), from.place});
      continue;
    }
    if (!from.name.empty()) {
      const auto [other, is_new] = names.emplace(std::pair{mission, from.name}, from.place);
      if (!is_new) {
        errors.push_back({ErrorKind::BadInput,
                          from.name + " is the name of the machine of " + other->second + ", too",
                          from.place});
      }
    }
    const auto controller = parse_controller(from.text, known.flavour);
    if (!controller) {
      errors.push_back({ErrorKind::BadInput, controller.error().message,
                        from.place + ", " + controller.error().where});
      continue;
    }
    for (const std::string& text :
         {from.name, mission, method, print_controller(*controller, known.flavour)})
      digest.add(text);
    add_design(addition,
               {.id = {++id},
                .mission = mission,
                .method = method,
                .flavour = known.flavour.name,
                .repetition = repetitions.next(mission, method),
                .seed = 0,
                .budget = 0},
               from, *controller, known.flavour);
  }
  if (!errors.empty()) return tl::unexpected(std::move(errors));
  ImportedWorld world = worlds.world();
  world.own_flavour = kept_flavour(known.flavour);
  std::string file = imported_text(world);
  if (!file.empty()) digest.add(file);  // imports without one keep their old digests
  addition.campaign = CampaignRow{.name = known.campaign,
                                  .digest = digest.hex(),
                                  .deciding = deciding_json(known, machines.size(), world),
                                  .file = std::move(file),
                                  .seed = 0};
  return addition;
}

}  // namespace swarmsmith
