#include "cli/commands/import_results.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "base/plain_text.h"
#include "base/text/json.h"
#include "base/text/whole_file.h"
#include "cli/arguments/store_argument.h"
#include "cli/arguments/world_argument.h"
#include "cli/commands/irace_converter.h"
#include "cli/replay/design_worlds.h"
#include "console/terminal.h"
#include "coordinator/results/imported_world.h"
#include "coordinator/results/irace_log_rows.h"
#include "coordinator/results/machine_import.h"
#include "coordinator/results/score_import.h"
#include "sim/control/foreign_text.h"
#include "sim/files/mission_file.h"

namespace swarmsmith::cli {
namespace {

namespace fs = std::filesystem;

/// Prints at most kMost errors.
ExitCode fail_all(Output& output, const std::vector<Error>& errors) {
  constexpr std::size_t kMost = 20;
  for (std::size_t i = 0; i < std::min(kMost, errors.size()); ++i)
    print_error(output, errors[i]);
  if (errors.size() > kMost) {
    print_error(output, {ErrorKind::BadInput,
                         "and " + std::to_string(errors.size() - kMost) + " more", ""});
  }
  print_error(output, {ErrorKind::BadInput, "nothing was imported", ""});
  return ExitCode::Usage;
}

/// The store that receives the import, locked, and its contents.
struct Target {
  std::unique_ptr<StoreAtRest> store;
  std::unique_ptr<StoreReader> reader;  ///< null for a new store
  std::vector<KnownDesign> designs;
};

Expected<Target> open_target(const std::string& path, StoreAtRest::IfMissing if_missing) {
  auto store = open_at_rest(path, if_missing);
  if (!store) {
    Error error = store.error();
    if (error.kind == ErrorKind::Conflict) error.message += "; import when the campaign has ended";
    return Unexpected(error);
  }
  Target target{.store = std::move(*store), .reader = {}, .designs = {}};
  if (target.store->is_new()) return target;
  auto reader = StoreReader::open(path);
  if (!reader) return Unexpected(reader.error());
  target.reader = std::move(*reader);
  auto designs = known_designs(*target.reader);
  if (!designs) return Unexpected(designs.error());
  target.designs = std::move(*designs);
  return target;
}

/// A note on the import, for people who look at the store later.
EventRow note_of(const ImportArguments& arguments, const std::string& what, std::size_t count) {
  const std::string file = fs::path(arguments.file).filename().string();
  return {.severity = "info",
          .kind = "imported",
          .text = JsonObject().add("file", file).add("what", what).add("count", count).text()};
}

/// "d3", or "d3 to d5".
std::string range_of(const std::vector<ImportedDesign>& designs) {
  const std::string first = to_string(designs.front().row.id);
  return designs.size() == 1 ? first : first + " to " + to_string(designs.back().row.id);
}

void print_imported(const std::string& what, const std::vector<ImportedDesign>& designs,
                    Output& output) {
  const auto id_of = [](const ImportedDesign& design) { return design.row.id; };
  output.out << JsonObject().add("imported", what).add("designs", json_list(designs, id_of)).text()
             << "\n";
}

/// Adds a campaign, unless the store has the same one already.
ExitCode add_campaign(const ImportArguments& arguments, Target target, Addition addition,
                      const std::string& what, Output& output) {
  if (target.reader) {
    const auto digests = imported_digests(*target.reader);
    if (!digests) return fail(output, ExitCode::Store, digests.error());
    if (std::ranges::find(*digests, addition.campaign->digest) != digests->end()) {
      print_note(output, "the store has this import already: nothing to add");
      if (output.json) print_imported(what, {}, output);
      return ExitCode::Done;
    }
  }
  addition.rows.emplace_back(note_of(arguments, what, addition.designs.size()));
  if (auto added = target.store->add(addition); !added) {
    return fail(output, ExitCode::Store, added.error());
  }
  warn_of_mixed_names(arguments.into, output);
  if (output.json) {
    print_imported(what, addition.designs, output);
  } else {
    output.out << what << " imported: " << range_of(addition.designs) << " of campaign "
               << addition.campaign->name << " in " << arguments.into << "\n";
  }
  return ExitCode::Done;
}

/// The name of the campaign made from a file: the file's name, if it is a valid one.
std::string campaign_name(const ImportArguments& arguments) {
  if (!arguments.name.empty()) return arguments.name;
  const std::string stem = fs::path(arguments.file).stem().string();
  return is_name(stem) ? stem : "imported";
}

/// Prints a note if an imported mission differs from a mission of the store with the same name.
Expected<void> compare_missions(const Addition& addition, StoreReader& store, Output& output) {
  const auto worlds = DesignWorlds::read(store);
  if (!worlds) return Unexpected(worlds.error());
  const auto imported = read_imported_world(addition.campaign->file);
  if (!imported) return Unexpected(imported.error());
  std::set<std::string> told;
  for (const KnownDesign& known : worlds->designs()) {
    const auto is_same = [&](const ImportedDesign& design) {
      return design.row.mission == known.mission;
    };
    if (told.contains(known.mission) || std::ranges::none_of(addition.designs, is_same)) continue;
    const auto world = worlds->of(known.id);
    if (!world || !*world || !(*world)->mission) continue;
    const auto entry = std::ranges::find_if(imported->missions, [&](const MissionEntry& each) {
      return each.mission.name == known.mission;
    });
    const auto mission = entry == imported->missions.end() ? built_in_mission(known.mission)
                                                           : Expected<Mission>(entry->mission);
    if (!mission || *mission == (*world)->mission->mission) continue;
    print_note(output, "warning: " + to_string(known.id) + " of the store has another mission " +
                           known.mission +
                           ", so that scores cannot be compared; rename it with "
                           "--mission " +
                           known.mission + "=NEW");
    told.insert(known.mission);
  }
  return {};
}

enum class Contents { Machines, Log, Scores };

/// The first option that has no effect on a file with these contents.
std::optional<Error> misplaced_option(const ImportArguments& arguments, Contents contents) {
  const bool has_scores = contents == Contents::Scores;
  const std::array<std::pair<const char*, bool>, 6> misplaced{
      {{"--flavour", has_scores && !arguments.flavour.empty()},
       {"--method", has_scores && !arguments.method.empty()},
       {"--name", has_scores && !arguments.name.empty()},
       {"--source", !has_scores && !arguments.source.empty()},
       {"--cost-of", !has_scores && !arguments.costs_of.empty()},
       {"--replace", !has_scores && arguments.replace}}};
  for (const auto& [option, is_misplaced] : misplaced) {
    if (!is_misplaced) continue;
    const char* what = contents == Contents::Log ? "a log of irace" : "machines";
    return Error{ErrorKind::BadInput,
                 std::string("it has no effect on ") + (has_scores ? "scores" : what), option};
  }
  return std::nullopt;
}

/// The flavour of --flavour, if it is given.
Expected<std::optional<Flavour>> said_flavour(const ImportArguments& arguments, Output& output) {
  if (arguments.flavour.empty()) return std::optional<Flavour>();
  auto found = find_flavour_or_complain(arguments.flavour, "--flavour", output);
  if (!found) return Unexpected(found.error());
  return std::optional(std::move(*found));
}

ExitCode import_machines_into(const ImportArguments& arguments,
                              OrErrors<std::vector<MachineText>> machines, Output& output) {
  if (!machines) return fail_all(output, machines.error());
  if (const auto misplaced = misplaced_option(arguments, Contents::Machines))
    return fail(output, ExitCode::Usage, *misplaced);
  const auto said = said_flavour(arguments, output);
  if (!said) return fail(output, ExitCode::Usage, said.error());
  const auto flavour = flavour_of(*machines, *said);
  if (!flavour) return fail(output, ExitCode::Usage, flavour.error());
  const auto missions = read_mission_words(arguments.missions);
  if (!missions) return fail_all(output, missions.error());
  auto target = open_target(arguments.into, StoreAtRest::IfMissing::Make);
  if (!target) return fail(output, ExitCode::Store, target.error());
  auto addition = import_machines(
      *machines, {.campaign = campaign_name(arguments),
                  .flavour = *flavour,
                  .missions = *missions,
                  .method = arguments.method.empty() ? flavour->name : arguments.method,
                  .designs = target->designs});
  if (!addition) return fail_all(output, addition.error());
  for (const MachineText& machine : *machines) {
    const auto remark = remark_about(machine.text);
    if (!remark) continue;
    print_note(output, machine.place + ": " + *remark);
    break;
  }
  if (target->reader) {
    if (const auto compared = compare_missions(*addition, *target->reader, output); !compared)
      return fail(output, ExitCode::Store, compared.error());
  }
  return add_campaign(arguments, std::move(*target), std::move(*addition), "machines", output);
}

ExitCode import_log_into(const ImportArguments& arguments,
                         const std::map<std::string, std::string>& texts, Output& output) {
  if (const auto misplaced = misplaced_option(arguments, Contents::Log))
    return fail(output, ExitCode::Usage, *misplaced);
  IraceImport known{.campaign = campaign_name(arguments), .flavour = {}, .designs = {}};
  auto flavour = said_flavour(arguments, output);
  if (!flavour) return fail(output, ExitCode::Usage, flavour.error());
  known.flavour = std::move(*flavour);
  const auto missions = read_mission_words(arguments.missions);
  if (!missions) return fail_all(output, missions.error());
  if (!missions->of_all.empty()) known.mission = missions->of_all;
  if (!arguments.method.empty()) known.method = arguments.method;
  const auto log = read_irace_log(texts);
  if (!log) return fail_all(output, log.error());
  auto target = open_target(arguments.into, StoreAtRest::IfMissing::Make);
  if (!target) return fail(output, ExitCode::Store, target.error());
  known.designs = target->designs;
  auto addition = irace_log_addition(*log, known);
  if (!addition) return fail_all(output, addition.error());
  ImportedWorld world;
  if (const MissionEntry* described = missions->of_file(known.mission))
    world.missions.push_back(*described);
  if (known.flavour) world.own_flavour = kept_flavour(*known.flavour);
  addition->campaign->file = imported_text(world);
  return add_campaign(arguments, std::move(*target), std::move(*addition), "irace log", output);
}

ExitCode import_scores_into(const ImportArguments& arguments, const CsvTable& table,
                            Output& output) {
  if (const auto misplaced = misplaced_option(arguments, Contents::Scores))
    return fail(output, ExitCode::Usage, *misplaced);
  const auto missions = read_mission_words(arguments.missions);
  if (!missions) return fail_all(output, missions.error());
  auto target = open_target(arguments.into, StoreAtRest::IfMissing::Refuse);
  if (!target) return fail(output, ExitCode::Store, target.error());
  auto ledger = ScoreLedger::read(*target->reader);
  if (!ledger) return fail(output, ExitCode::Store, ledger.error());
  std::optional<Error> trouble;
  const auto has = [&](CandidateId candidate) {
    const auto known = has_candidate(*target->reader, candidate);
    if (!known) trouble = known.error();
    return known.value_or(false);
  };
  auto scores = import_scores(table,
                              {.missions = *missions,
                               .source = arguments.source,
                               .costs_of = arguments.costs_of,
                               .replace = arguments.replace,
                               .designs = target->designs,
                               .has_candidate = has},
                              std::move(*ledger));
  if (trouble) return fail(output, ExitCode::Store, *trouble);
  if (!scores) return fail_all(output, scores.error());
  for (const std::string& column : scores->not_read)
    print_note(output, "column " + column + " is ignored");
  const std::int64_t written = scores->added + scores->replaced;
  if (written > 0) {
    scores->addition.rows.emplace_back(
        note_of(arguments, "scores", static_cast<std::size_t>(written)));
    if (auto added = target->store->add(scores->addition); !added) {
      return fail(output, ExitCode::Store, added.error());
    }
  }
  if (output.json) {
    output.out << JsonObject()
                      .add("imported", "scores")
                      .add("added", scores->added)
                      .add("replaced", scores->replaced)
                      .add("known", scores->known)
                      .text()
               << "\n";
  } else {
    output.out << counted(scores->added, "score") << " imported into " << arguments.into << ", "
               << scores->replaced << " replaced, " << scores->known << " already there\n";
  }
  return ExitCode::Done;
}

ExitCode import_table_into(const ImportArguments& arguments, const std::string& text,
                           Output& output) {
  const auto table = parse_csv(text, arguments.file);
  if (!table) return fail_all(output, table.error());
  if (has_machines(*table) && !has_scores(*table)) {
    return import_machines_into(arguments, read_machine_table(*table), output);
  }
  if (has_scores(*table)) return import_scores_into(arguments, *table, output);
  return fail(output, ExitCode::Usage,
              Error{ErrorKind::BadInput,
                    "neither scores nor machines: no column score, cost, fsm or fsm_config",
                    arguments.file});
}

}  // namespace

ExitCode import_into_store(const ImportArguments& arguments, Output& output) {
  std::error_code ignored;
  if (fs::is_directory(arguments.file, ignored)) {
    return import_log_into(arguments, read_log_folder(arguments.file), output);
  }
  const auto text = read_file(arguments.file, "results");
  if (!text) return fail(output, ExitCode::Usage, text.error());
  const std::string ending = fs::path(arguments.file).extension().string();
  if (ending == ".csv") return import_table_into(arguments, *text, output);
  if (ending != ".Rdata" && ending != ".RData" && ending != ".rda") {
    return import_machines_into(arguments, read_machine_lines(*text, arguments.file), output);
  }
  const auto tables = convert_irace_log(arguments.file, output);
  if (tables) return import_log_into(arguments, *tables, output);
  const bool no_r = tables.error().kind == ErrorKind::Unavailable;
  return fail(output, no_r ? ExitCode::Failed : ExitCode::Usage, tables.error());
}

}  // namespace swarmsmith::cli
