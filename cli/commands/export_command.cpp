#include <algorithm>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>

#include "base/text/json.h"
#include "base/text/whole_file.h"
#include "cli/arguments/store_argument.h"
#include "cli/arguments/thing_id.h"
#include "cli/commands/commands.h"
#include "cli/commands/export_formats.h"
#include "cli/output/query_output.h"
#include "cli/replay/machine_filer.h"
#include "cli/replay/stored_instances.h"
#include "console/terminal.h"

namespace swarmsmith::cli {
namespace {

struct ExportArguments {
  StoreArgument store;
  std::string what = "best";
  std::string format = "fsm-config";
  std::string file;
  std::string design;
  std::string candidate;
  std::string mission;
  std::string width;
  std::optional<std::int64_t> seed;
  std::string irace_version;  ///< empty: not given
};

/// The number after the letter of an id.
Expected<std::string> digits_of(const std::string& text, char letter, const char* option) {
  const auto id = parse_thing_id(text);
  if (id && id->letter == letter) return id->digits;
  const std::string example = letter == 'd' ? "d3" : "c812";
  return bad_input("must be an id such as " + example + ", not \"" + text + "\"", option);
}

/// SQL for machines, with the facts about each that people want to know; `selected` returns
/// (design, candidate).
Expected<std::string> statement(const ExportArguments& arguments) {
  const std::string& what = arguments.what;
  std::string selected =
      "SELECT design, best_candidate AS candidate FROM v_designs "
      "WHERE best_candidate IS NOT NULL";
  if (what == "elites") {
    selected =
        "SELECT design, candidate FROM v_convergence AS e WHERE iteration = "
        "(SELECT max(iteration) FROM v_convergence AS l WHERE l.design = e.design)";
  }
  if (what == "all") selected = "SELECT design, candidate FROM v_candidates";
  std::string which;
  if (!arguments.candidate.empty()) {
    const auto digits = digits_of(arguments.candidate, 'c', "--candidate");
    if (!digits) return Unexpected(digits.error());
    selected = "SELECT design, candidate FROM v_candidates WHERE candidate = " + *digits;
  }
  if (!arguments.design.empty()) {
    const auto digits = digits_of(arguments.design, 'd', "--design");
    if (!digits) return Unexpected(digits.error());
    which = " WHERE s.design = " + *digits;
  }
  return "SELECT s.design, d.mission, d.method, d.repetition, s.candidate, c.iteration, c.mean, "
         "c.runs, c.fsm_config, c.parameters, c.modules FROM (" +
         selected +
         ") AS s JOIN v_designs AS d ON d.design = s.design "
         "JOIN v_candidates AS c ON c.candidate = s.candidate" +
         which + " ORDER BY s.design, s.candidate";
}

enum Column {
  kDesign,
  kMission,
  kMethod,
  kRepetition,
  kCandidate,
  kIteration,
  kMean,
  kRuns,
  kText,
  kParameters,
  kModules
};

CandidateId candidate_of(const std::vector<StoreReader::Cell>& cells) {
  return {cells[kCandidate].integer()};
}

/// JSON with parameters and modules, which are JSON in the store already.
Expected<std::string> as_json(const Rows& rows, MachineFiler& filer) {
  JsonPiece machines{"["};
  // Both are JSON objects in the store.
  const auto object_or_empty = [](const std::string& json) {
    return JsonPiece{json.empty() ? "{}" : json};
  };
  for (const auto& cells : rows.cells) {
    Rows plain{.columns = {rows.columns.begin(), rows.columns.begin() + kParameters},
               .cells = {{cells.begin(), cells.begin() + kParameters}},
               .truncated = false};
    letter_ids(plain);
    JsonObject object = row_as_json(plain, 0);
    const auto head = filer.head_of(candidate_of(cells));
    if (!head) return Unexpected(head.error());
    if (!head->flavour.empty()) object.add("flavour", head->flavour);
    if (head->turn_clock) object.add("turn_clock", name_of(*head->turn_clock));
    if (head->profile) object.add("profile", head->profile->name);
    if (!head->seeds.empty()) object.add("seeds", head->seeds);
    object.add("parameters", object_or_empty(cells[kParameters].text))
        .add("modules", object_or_empty(cells[kModules].text));
    machines.text += (machines.text.size() == 1 ? "" : ",") + object.text();
  }
  machines.text += "]";
  return JsonObject().add("machines", machines).text() + "\n";
}

ExitCode write_text(const ExportArguments& arguments, const std::string& text, Output& output) {
  if (arguments.file.empty()) {
    write_data(output, text);
    return ExitCode::Done;
  }
  const auto done = write_whole_file(arguments.file, text);
  return done ? ExitCode::Done : fail(output, ExitCode::Failed, done.error());
}

/// Whether starts or patches are wanted instead of machines.
bool asks_for_table(const ExportArguments& arguments) {
  return arguments.what == "starts" || arguments.what == "patches";
}

bool is_picture(const std::string& format) {
  return format == "svg" || format == "pdf" || format == "dot" || format == "tikz";
}

/// The first option that has no effect with this format.
std::optional<Error> misplaced_option(const ExportArguments& arguments) {
  const std::string with = " has no effect with --format " + arguments.format;
  if (arguments.seed && arguments.format != "argos") {
    return Error{ErrorKind::BadInput, "it" + with, "--seed"};
  }
  const bool sized = is_picture(arguments.format) && arguments.format != "dot";
  if (!arguments.width.empty() && !sized) return Error{ErrorKind::BadInput, "it" + with, "--width"};
  const bool is_design = arguments.format == "rdata" || arguments.format == "irace";
  if (is_design && (!arguments.candidate.empty() || arguments.what != "best")) {
    return Error{ErrorKind::BadInput,
                 "it" + with + ": " + (arguments.format == "rdata" ? "the log" : "the folder") +
                     " has all of a design",
                 arguments.candidate.empty() ? "--what" : "--candidate"};
  }
  if (!arguments.irace_version.empty() && arguments.format != "irace")
    return Error{ErrorKind::BadInput, "it" + with, "--irace"};
  if (asks_for_table(arguments) && arguments.format != "fsm-config") {
    return Error{ErrorKind::BadInput,
                 "--what " + arguments.what + " writes a table: leave --format out", "--format"};
  }
  if (!arguments.mission.empty() && !asks_for_table(arguments)) {
    return Error{ErrorKind::BadInput, "it has no effect with --what " + arguments.what,
                 "--mission"};
  }
  if (!arguments.candidate.empty() && asks_for_table(arguments)) {
    return Error{ErrorKind::BadInput, "it has no effect with --what " + arguments.what,
                 "--candidate"};
  }
  return std::nullopt;
}

std::vector<CandidateId> candidates_of(const Rows& rows) {
  std::vector<CandidateId> candidates;
  for (const auto& cells : rows.cells)
    candidates.push_back(candidate_of(cells));
  return candidates;
}

/// It is not an error if there is nothing to export, unless the user named it.
ExitCode nothing_found(const ExportArguments& arguments, Output& output) {
  if (arguments.design.empty() && arguments.candidate.empty()) {
    print_note(output, "the store has no such machines yet");
    return ExitCode::Done;
  }
  const bool named = !arguments.candidate.empty();
  return fail(output, ExitCode::NoSuchId,
              named ? "the store has no candidate " + arguments.candidate +
                          (arguments.design.empty() ? "" : " in " + arguments.design)
                    : "the store has no such machine of " + arguments.design);
}

/// Writes comments, heads and texts; in a folder one file each: d3-c812.fsm.
ExitCode write_machines(const ExportArguments& arguments, const Rows& rows, MachineFiler& filer,
                        Output& output) {
  std::error_code not_there;
  const bool folder = std::filesystem::is_directory(arguments.file, not_there);
  std::string all;
  for (const auto& cells : rows.cells) {
    const CandidateId candidate = candidate_of(cells);
    auto text = filer.text_of(candidate);
    if (!text) return fail(output, ExitCode::Store, text.error());
    if (!folder) {
      all += *text;
      continue;
    }
    const auto file = std::filesystem::path(arguments.file) /
                      (to_string(design_of(candidate)) + "-" + to_string(candidate) + ".fsm");
    const auto done = write_whole_file(file, *text);
    if (!done) return fail(output, ExitCode::Failed, done.error());
  }
  return folder ? ExitCode::Done : write_text(arguments, all, output);
}

std::string names_of(const std::vector<ScoredMission>& missions) {
  std::string names;
  for (const ScoredMission& scored : missions)
    names += (names.empty() ? "" : ", ") + scored.name;
  return names;
}

/// The starts or patches of one mission, in the format that `evaluate` reads.
ExitCode write_table(const ExportArguments& arguments, StoreReader& store, Output& output) {
  MissionFilter filter{.mission = arguments.mission, .design = {}};
  if (!arguments.design.empty()) {
    const auto digits = digits_of(arguments.design, 'd', "--design");
    if (!digits) return fail(output, ExitCode::Usage, digits.error());
    filter.design = DesignId{std::stoll(*digits)};
  }
  auto missions = scored_missions(store, filter);
  if (!missions) return fail(output, ExitCode::Store, missions.error());
  const bool patches = arguments.what == "patches";
  if (patches) {
    std::erase_if(*missions, [](const ScoredMission& scored) {
      return scored.mission.shuffled.places.empty();
    });
  }
  if (missions->empty() && !arguments.mission.empty()) {
    const auto known = scored_missions(store);
    if (!known) return fail(output, ExitCode::Store, known.error());
    return fail(output, ExitCode::NoSuchId,
                "no winner of a mission \"" + arguments.mission +
                    (patches ? "\" with patches that change with the seed" : "\"") +
                    " was scored after its race; there are: " + names_of(*known));
  }
  if (missions->empty()) {
    return fail(output, ExitCode::NoSuchId,
                patches ? "no such mission has patches that change with the seed, and scores of a "
                          "winner"
                        : "no winner of such a mission was scored after its race");
  }
  if (missions->size() > 1) {
    return fail(output, ExitCode::Usage,
                "a table has one mission; name it with --mission, or a --design of it: " +
                    names_of(*missions));
  }
  const auto text = patches ? patches_table(missions->front()) : starts_table(missions->front());
  if (!text) return fail(output, ExitCode::Failed, text.error());
  return write_text(arguments, *text, output);
}

ExitCode run_export(const ExportArguments& arguments, Output& output) {
  if (const auto misplaced = misplaced_option(arguments)) {
    return fail(output, ExitCode::Usage, *misplaced);
  }
  if (arguments.format == "irace") {
    const auto source = arguments.store.path();
    if (!source) return fail(output, ExitCode::Usage, source.error());
    return export_irace(
        *source,
        {.design = arguments.design,
         .version = arguments.irace_version.empty() ? "4" : arguments.irace_version},
        arguments.file, output);
  }
  if (arguments.format == "rdata") {
    const auto store = arguments.store.open_whole();
    if (!store) return fail(output, exit_code_of_store(store.error()), store.error());
    return export_rdata(**store, arguments.design, arguments.file, output);
  }
  if (asks_for_table(arguments)) {
    const auto store = arguments.store.open_whole();
    if (!store) return fail(output, exit_code_of_store(store.error()), store.error());
    return write_table(arguments, **store, output);
  }
  const auto sql = statement(arguments);
  if (!sql) return fail(output, ExitCode::Usage, sql.error());
  const auto store = arguments.store.open_whole();
  if (!store) return fail(output, exit_code_of_store(store.error()), store.error());
  auto rows = select(**store, *sql,
                     {.rows = 1'000'000'000,
                      .seconds = 600,
                      .bytes = std::numeric_limits<std::int64_t>::max(),
                      .memory = std::int64_t{1} << 30U});
  if (!rows) return fail(output, ExitCode::Store, rows.error());
  if (rows->cells.empty()) {
    const ExitCode code = nothing_found(arguments, output);
    if (code != ExitCode::Done) return code;
  }
  if (is_picture(arguments.format) || arguments.format == "argos") {
    return export_machines(**store, candidates_of(*rows),
                           {.format = arguments.format,
                            .width = arguments.width,
                            .seed = arguments.seed.value_or(1),
                            .place = arguments.file},
                           output);
  }
  auto filer = MachineFiler::open(**store);
  if (!filer) return fail(output, ExitCode::Store, filer.error());
  const bool json = output.json || arguments.format == "json";
  if (!json) return write_machines(arguments, *rows, *filer, output);
  const auto text = as_json(*rows, *filer);
  if (!text) return fail(output, ExitCode::Store, text.error());
  return write_text(arguments, *text, output);
}

}  // namespace

CommandRun declare_export(Options& options) {
  auto arguments = std::make_shared<ExportArguments>();
  arguments->store.declare(options);
  options.choice("--what", arguments->what, {"best", "elites", "all", "starts", "patches"},
                 "Each design's best machine, its last elites, or every candidate; or a table for "
                 "`evaluate`: the starts of the robots, or the places of the patches, in the runs "
                 "that scored a mission's winners");
  options.choice("--format", arguments->format,
                 {"fsm-config", "json", "svg", "pdf", "dot", "tikz", "argos", "irace", "rdata"},
                 "Text of the grammar with lines on its origin, JSON, a picture, an experiment "
                 "file of the original simulator, a folder in which R's irace runs the same "
                 "design, or a design's race as the log of R's irace, for iraceplot");
  options.text("-o,--output FILE", arguments->file,
               "File to write, or folder for one file per machine or for the tables of a log");
  options.text("--design DESIGN", arguments->design, "Only machines of this design, such as d3");
  options.text("--candidate CANDIDATE", arguments->candidate, "Only this candidate, such as c812");
  options.text("--mission MISSION", arguments->mission, "Mission of --what starts or patches");
  options.text("--width WIDTH", arguments->width,
               "Width of a picture: 84mm (default), 8.4cm, 3.3in");
  options.integer("--seed", arguments->seed, {1, 4'294'967'295},
                  "Seed of the experiment of --format argos (default 1)");
  options.choice("--irace", arguments->irace_version, {"3.5", "4"},
                 "Version of irace for --format irace (default 4)");
  return [arguments](Output& output) { return run_export(*arguments, output); };
}

}  // namespace swarmsmith::cli
