#include "cli/commands/export_formats.h"

#include <algorithm>
#include <filesystem>
#include <utility>
#include <variant>

#include <fmt/format.h>

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

/// The mission as the store's campaign has it.
Expected<Mission> mission_of(StoreReader& store, DesignId design, const std::string& name) {
  const auto stored = store.campaign_of(design);
  if (!stored) return Unexpected(stored.error());
  if (stored->row.file.empty() || is_imported_text(stored->row.file)) {
    const auto world = read_imported_world(stored->row.file);
    if (!world) return Unexpected(world.error());
    for (const MissionEntry& entry : world->missions)
      if (entry.mission.name == name) return entry.mission;
    return built_in_mission(name);
  }
  const auto campaign = parse_campaign(stored->row.file, "campaign.toml");
  if (!campaign) return Unexpected(campaign.error().front());
  const auto found = std::ranges::find_if(
      campaign->missions, [&](const CampaignMission& known) { return known.mission.name == name; });
  if (found != campaign->missions.end()) return found->mission;
  return unexpected(ErrorKind::NotFound,
                    "the store's campaign does not say what the mission " + name + " is");
}

Expected<std::string> experiment_of(StoreReader& store, const MachineRecord& candidate,
                                    const StoredController& stored, const MachineExport& what) {
  const auto* machine = std::get_if<Machine>(&stored.controller);
  if (machine == nullptr) {
    return bad_input(
        fmt::format("the control software is a {}, and .argos files are of state "
                    "machines alone",
                    name_of(architecture_of(stored.controller))));
  }
  const auto mission = mission_of(store, candidate.design, candidate.mission);
  if (!mission) return Unexpected(mission.error());
  return argos_experiment(
      {.machine = *machine, .mission = *mission, .seed = what.seed, .title = title_of(candidate)});
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

/// Behaviours of another flavour do something else with the same numbers.
void remark_flavours(StoreReader& store, CandidateId first, Output& output) {
  const auto record = candidate(store, first);
  if (!record || record->flavour == watermelon_argos3().name) return;
  print_note(output, "the machines were designed for the flavour " + record->flavour +
                         "; the original's modules are those of watermelon-argos3, so scores will "
                         "differ (docs/flavours.md)");
}

ExitCode code_of(const Error& error) {
  if (error.kind == ErrorKind::NotFound) return ExitCode::NoSuchId;
  return error.kind == ErrorKind::BadInput ? ExitCode::Usage : ExitCode::Failed;
}

/// Only machines have experiment files. Where some are among others, the others are left out.
Expected<std::vector<CandidateId>> with_experiments(StoreReader& store,
                                                    const std::vector<CandidateId>& candidates) {
  std::vector<CandidateId> machines;
  for (const CandidateId id : candidates) {
    const auto record = candidate(store, id);
    if (!record) return Unexpected(record.error());
    if (architecture_of_text(record->machine).value_or(Architecture::Machine) ==
        Architecture::Machine)
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
                              " machines are as many files; name a folder with -o FOLDER, or one "
                              "machine with --design or --candidate"
                        : "name a file with -o FILE");
  }
  std::error_code trouble;
  if (several && fs::path(what.place).extension() == "." + ending_of(what.format) &&
      !fs::is_directory(what.place, trouble)) {
    return fail(output, ExitCode::Usage,
                {ErrorKind::BadInput,
                 std::to_string(candidates.size()) +
                     " machines are as many files; name a folder, or one machine with --design or "
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
    print_note(output, fmt::format("{} of {} are left out: they are trees or networks, and .argos "
                                   "files are of state machines alone",
                                   left_out, chosen.size()));
  }
  if (what.format == "argos") remark_flavours(store, candidates.front(), output);
  if (!output.json) return ExitCode::Done;
  output.out << JsonObject().add("files", files).text() << "\n";
  return ExitCode::Done;
}

}  // namespace swarmsmith::cli
