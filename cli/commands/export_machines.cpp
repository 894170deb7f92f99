#include "cli/commands/export_formats.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>
#include <utility>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "analysis/figures/machine_figure.h"
#include "analysis/machines/controller_drawing.h"
#include "analysis/machines/machine_layout.h"
#include "base/output_file.h"
#include "base/text/json.h"
#include "base/text/whole_file.h"
#include "console/pdf.h"
#include "console/terminal.h"
#include "coordinator/campaign/argos_experiment.h"
#include "coordinator/campaign/campaign_file.h"
#include "coordinator/results/imported_world.h"
#include "sim/files/profile_file.h"

namespace swarmsmith::cli {
namespace {

namespace fs = std::filesystem;

constexpr double kWidest_mm = 1000;

std::string ending_of(const std::string& format) {
  return format == "tikz" ? "tex" : format;
}

Expected<double> width_of(const MachineExport& what) {
  if (what.width.empty()) return 84;
  const double width = millimetres_from_text(what.width);
  if (width >= kNarrowestMachine_mm && width <= kWidest_mm) return width;
  return bad_input(
      "a machine's picture is 60mm to 1000mm wide (also cm, in), not \"" + what.width + "\"",
      "--width");
}

Expected<std::string> picture_of(const MachineRecord& candidate, const StoredController& stored,
                                 const MachineExport& what, double width) {
  ControllerDrawing drawing =
      drawing_of(stored.controller, *stored.flavour, width, title_of(candidate));
  if (what.format == "tikz") return std::move(drawing.tikz);
  if (what.format == "dot") return std::move(drawing.dot);
  if (what.format == "pdf") return pdf_of_svg(drawing.svg.finish());
  return drawing.svg.finish();
}

struct World {
  Mission mission;
  Profile profile;
};

/// The mission and the profile of the store's campaign. If it has no profile, e-pucks get the
/// published one; files of RVRs have none.
Expected<World> world_of(StoreReader& store, DesignId design, const std::string& name) {
  const auto stored = store.campaign_of(design);
  if (!stored) return Unexpected(stored.error());
  if (stored->row.file.empty() || is_imported_text(stored->row.file)) {
    const auto world = read_imported_world(stored->row.file);
    if (!world) return Unexpected(world.error());
    const Profile published = built_in_profile("epuck").value();
    const Profile profile = world->profile.value_or(published);
    for (const MissionEntry& entry : world->missions)
      if (entry.mission.name == name) return World{entry.mission, profile};
    const auto mission = built_in_mission(name);
    if (!mission) return Unexpected(mission.error());
    return World{*mission, profile};
  }
  const auto campaign = parse_campaign(stored->row.file, "campaign.toml");
  if (!campaign) return Unexpected(campaign.error().front());
  const auto found = std::ranges::find_if(
      campaign->missions, [&](const CampaignMission& known) { return known.mission.name == name; });
  if (found != campaign->missions.end()) return World{found->mission, campaign->profile};
  return unexpected(ErrorKind::NotFound,
                    "the store's campaign does not describe the mission " + name + " is");
}

Expected<std::string> experiment_of(StoreReader& store, const MachineRecord& candidate,
                                    const StoredController& stored, const MachineExport& what) {
  const auto world = world_of(store, candidate.design, candidate.mission);
  if (!world) return Unexpected(world.error());
  return argos_experiment({.controller = stored.controller,
                           .mission = world->mission,
                           .profile = world->profile,
                           .seed = what.seed,
                           .title = title_of(candidate)});
}

struct NamedBytes {
  std::string name;
  std::string bytes;
};

Expected<NamedBytes> written(StoreReader& store, CandidateId id, const MachineExport& what,
                             double width) {
  const auto record = candidate(store, id);
  if (!record) return Unexpected(record.error());
  const auto stored = controller_of(*record, store);
  if (!stored) return Unexpected(stored.error());
  auto bytes = what.format == "argos" ? experiment_of(store, *record, *stored, what)
                                      : picture_of(*record, *stored, what, width);
  if (!bytes) {
    Error error = bytes.error();
    error.where = to_string(id) + (error.where.empty() ? "" : ", " + error.where);
    return Unexpected(std::move(error));
  }
  return NamedBytes{to_string(record->design) + "-" + to_string(id) + "." + ending_of(what.format),
                    std::move(*bytes)};
}

/// Flavours that use the original modules: on the RVR, and of the e-puck's machines and trees.
constexpr std::array<std::string_view, 3> kOriginalFlavours = {"watermelon-argos3",
                                                               "chocolate-epuck", "maple-epuck"};

/// Whether the candidate is of a flavour for e-pucks.
bool is_of_epucks(const MachineRecord& candidate, StoreReader& store) {
  const auto stored = controller_of(candidate, store);
  return stored && stored->flavour->reference != kRvrModel;
}

/// Notes that behaviours of another flavour do something else with the same numbers. Names each
/// flavour once.
void remark_flavours(StoreReader& store, const std::vector<CandidateId>& candidates,
                     Output& output) {
  std::set<std::string> remarked(kOriginalFlavours.begin(), kOriginalFlavours.end());
  for (const CandidateId id : candidates) {
    const auto record = candidate(store, id);
    if (!record || !remarked.insert(record->flavour).second) continue;
    const bool is_tree = architecture_of_text(record->machine) == Architecture::Tree;
    const std::string_view original = kOriginalFlavours.at(!is_of_epucks(*record, store) ? 0
                                                           : is_tree                     ? 2
                                                                                         : 1);
    print_note(output, fmt::format("the machines were designed for the flavour {}; the original's "
                                   "modules are those of {}, so scores will differ "
                                   "(docs/flavours.md)",
                                   record->flavour, original));
  }
}

/// Notes on the profiles of e-pucks; each profile once.
void remark_profiles(StoreReader& store, const std::vector<CandidateId>& candidates,
                     Output& output) {
  std::set<std::string> remarked;
  for (const CandidateId id : candidates) {
    const auto record = candidate(store, id);
    if (!record || !is_of_epucks(*record, store)) continue;
    const auto world = world_of(store, record->design, record->mission);
    if (!world || !remarked.insert(world->profile.name).second) continue;
    const std::vector<std::string> keys = left_out_of_argos(world->profile);
    if (keys.empty()) continue;
    print_note(output,
               fmt::format("an experiment file cannot express these keys of the profile {}, so "
                           "scores will differ: {}",
                           world->profile.name, fmt::join(keys, ", ")));
  }
}

ExitCode code_of(const Error& error) {
  if (error.kind == ErrorKind::NotFound) return ExitCode::NoSuchId;
  return error.kind == ErrorKind::BadInput ? ExitCode::Usage : ExitCode::Failed;
}

/// Only machines, and trees of e-pucks, have experiment files. If the list contains some of these,
/// the other candidates are left out.
Expected<std::vector<CandidateId>> with_experiments(StoreReader& store,
                                                    const std::vector<CandidateId>& candidates) {
  std::vector<CandidateId> machines;
  for (const CandidateId id : candidates) {
    const auto record = candidate(store, id);
    if (!record) return Unexpected(record.error());
    const Architecture architecture =
        architecture_of_text(record->machine).value_or(Architecture::Machine);
    if (architecture == Architecture::Machine ||
        (architecture == Architecture::Tree && is_of_epucks(*record, store)))
      machines.push_back(id);
  }
  return machines.empty() ? candidates : machines;
}

}  // namespace

ExitCode export_machines(StoreReader& store, const std::vector<CandidateId>& chosen,
                         const MachineExport& what, Output& output) {
  auto kept = what.format == "argos" ? with_experiments(store, chosen) : chosen;
  if (!kept) return fail(output, code_of(kept.error()), kept.error());
  const std::vector<CandidateId>& candidates = *kept;
  const auto width = width_of(what);
  if (!width) return fail(output, ExitCode::Usage, width.error());
  if (candidates.empty()) return ExitCode::Done;
  const bool several = candidates.size() > 1;
  if (what.place.empty() && (several || what.format == "pdf" || output.json)) {
    return fail(output, ExitCode::Usage,
                several ? std::to_string(candidates.size()) +
                              " machines need as many files; name a folder with -o FOLDER, or one "
                              "machine with --design or --candidate"
                        : "name a file with -o FILE");
  }
  std::error_code trouble;
  if (several && fs::path(what.place).extension() == "." + ending_of(what.format) &&
      !fs::is_directory(what.place, trouble)) {
    return fail(output, ExitCode::Usage,
                {ErrorKind::BadInput,
                 std::to_string(candidates.size()) +
                     " machines need as many files; name a folder, or one machine with --design or "
                     "--candidate",
                 what.place});
  }
  const bool folder = several || fs::is_directory(what.place, trouble);
  if (several) fs::create_directories(what.place, trouble);
  if (several && !fs::is_directory(what.place, trouble)) {
    return fail(output, ExitCode::Failed, cannot_write(what.place));
  }
  std::vector<std::string> files;
  for (const CandidateId id : candidates) {
    const auto text = written(store, id, what, *width);
    if (!text) return fail(output, code_of(text.error()), text.error());
    if (what.place.empty()) {
      write_data(output, text->bytes);
      continue;
    }
    files.push_back(folder ? (fs::path(what.place) / text->name).string() : what.place);
    if (const auto done = write_whole_file(files.back(), text->bytes); !done) {
      return fail(output, ExitCode::Failed, done.error());
    }
  }
  if (const std::size_t left_out = chosen.size() - candidates.size(); left_out > 0) {
    print_note(
        output,
        fmt::format(
            "{} of {} are left out: .argos files can hold state machines, and for e-pucks trees",
            left_out, chosen.size()));
  }
  if (what.format == "argos") {
    remark_flavours(store, candidates, output);
    remark_profiles(store, candidates, output);
  }
  if (!output.json) return ExitCode::Done;
  output.out << JsonObject().add("files", files).text() << "\n";
  return ExitCode::Done;
}

}  // namespace swarmsmith::cli
