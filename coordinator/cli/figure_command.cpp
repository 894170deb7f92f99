#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

#include "analysis/drawing/svg.h"
#include "analysis/figures/figure.h"
#include "base/suggestion.h"
#include "coordinator/cli/commands.h"
#include "coordinator/cli/pdf.h"
#include "coordinator/cli/query_output.h"
#include "coordinator/cli/store_argument.h"
#include "coordinator/cli/thing_id.h"
#include "coordinator/cli/whole_file.h"

namespace swarmsmith::cli {
namespace {

struct Arguments {
  std::string kind;
  StoreArgument store;
  std::string file;
  std::string width;
  std::string design;
  std::string candidate;
  FigureOptions options;
};

/// A line a kind, with its options below it.
std::string kinds_text() {
  std::string text = "Kinds:\n";
  for (const FigureKind& kind : figure_kinds()) {
    const std::string name(kind.name);
    text += "  " + name + std::string(name.size() < 12 ? 12 - name.size() : 1, ' ') +
            std::string(kind.summary) + "\n";
    std::string options(kind.options);
    for (std::size_t at = 0; (at = options.find(' ', at)) != std::string::npos; at += 4)
      options.replace(at, 1, ", --");
    if (!options.empty()) text += std::string(14, ' ') + "--" + options + "\n";
  }
  return text;
}

std::string kinds_json() {
  std::string text;
  for (const FigureKind& kind : figure_kinds()) {
    text += std::string(text.empty() ? "" : ",") + "{\"kind\":" + json_text(kind.name) +
            ",\"summary\":" + json_text(kind.summary) + "}";
  }
  return "{\"kinds\":[" + text + "]}\n";
}

/// Rows below the headline; a row may have line feeds in quotes.
std::size_t rows_of_csv(const std::string& csv) {
  std::size_t rows = 0;
  bool quoted = false;
  for (const char letter : csv) {
    if (letter == '"') quoted = !quoted;
    if (letter == '\n' && !quoted) ++rows;
  }
  return rows == 0 ? 0 : rows - 1;
}

/// The number behind `letter` in d3 or c812.
Expected<std::int64_t> number_of(const std::string& text, char letter, const char* option) {
  const auto id = parse_thing_id(text);
  if (id && id->letter == letter) return std::stoll(id->digits);
  const std::string example = letter == 'd' ? "d3" : "c812";
  return bad_input("wants an id such as " + example + ", not \"" + text + "\"", option);
}

/// What the words mean, before any store is opened.
Expected<FigureOptions> read_options(const Arguments& arguments) {
  FigureOptions options = arguments.options;
  if (!arguments.design.empty()) {
    const auto design = number_of(arguments.design, 'd', "--design");
    if (!design) return Unexpected(design.error());
    options.filter.design = DesignId{*design};
  }
  if (!arguments.candidate.empty()) {
    const auto candidate = number_of(arguments.candidate, 'c', "--candidate");
    if (!candidate) return Unexpected(candidate.error());
    options.candidate = CandidateId{*candidate};
  }
  if (arguments.width.empty()) return options;
  options.width_mm = millimetres_from_text(arguments.width);
  if (options.width_mm >= kLeastFigureWidth_mm && options.width_mm <= kMostFigureWidth_mm)
    return options;
  return bad_input("a figure is 60mm to 1000mm wide (also cm, in), not \"" + arguments.width + "\"",
                   "--width");
}

/// The ending of the file's name, which says what is written; ".svg" for standard output.
Expected<std::string> ending_of(const Arguments& arguments, const Output& output) {
  if (arguments.file.empty() || arguments.file == "-") {
    if (!output.json) return std::string(".svg");
    return bad_input("standard output has the answer of --json; name a file for the figure", "-o");
  }
  std::string ending = std::filesystem::path(arguments.file).extension().string();
  for (const char* known : {".svg", ".pdf", ".csv", ".tex"})
    if (ending == known) return ending;
  return bad_input("the file's ending says what is written: .svg, .pdf, .csv or .tex",
                   arguments.file);
}

/// A name that no design of the store has, with those that there are.
std::optional<Error> unknown_name(const std::string& given, const char* option,
                                  std::vector<std::string> known) {
  if (given.empty() || std::ranges::find(known, given) != known.end()) return std::nullopt;
  std::ranges::sort(known);
  const auto same = std::ranges::unique(known);
  known.erase(same.begin(), same.end());
  return Error{ErrorKind::BadInput,
               "the store has no \"" + given + "\"" + did_you_mean(given, known) +
                   "; it has: " + joined(known),
               option};
}

/// What is asked for and not in the store: a mission, a method (BadInput), an id (NotFound).
std::optional<Error> missing_in(StoreReader& store, const FigureOptions& options) {
  const auto all = designs(store, {});
  if (!all) return all.error();
  std::vector<std::string> missions;
  std::vector<std::string> methods;
  bool has_design = !options.filter.design;
  for (const DesignRecord& design : *all) {
    missions.push_back(design.mission);
    methods.push_back(design.method);
    has_design = has_design || design.design == *options.filter.design;
  }
  if (auto error = unknown_name(options.filter.mission, "--mission", std::move(missions)))
    return error;
  if (auto error = unknown_name(options.filter.method, "--method", std::move(methods)))
    return error;
  if (!has_design) {
    return Error{ErrorKind::NotFound,
                 "the store has no design " + to_string(*options.filter.design), "--design"};
  }
  if (!options.candidate) return std::nullopt;
  const auto found = select(store, "SELECT 1 FROM v_candidates WHERE candidate = " +
                                       std::to_string(options.candidate->value));
  if (!found) return found.error();
  if (!found->cells.empty()) return std::nullopt;
  return Error{ErrorKind::NotFound, "the store has no candidate " + to_string(*options.candidate),
               "--candidate"};
}

ExitCode exit_code_of(const Error& error) {
  return error.kind == ErrorKind::NotFound ? ExitCode::NoSuchId : ExitCode::Usage;
}

/// The bytes of the file with this ending.
Expected<std::string> bytes_of(Figure figure, const std::string& ending, const std::string& kind) {
  if (ending == ".csv") return std::move(figure.csv);
  if (ending == ".pdf") return pdf_of_svg(figure.svg);
  if (ending == ".svg") return std::move(figure.svg);
  if (!figure.tex.empty()) return std::move(figure.tex);
  return bad_input("the figure `" + kind + "` has no TeX form; write an .svg, .pdf or .csv", "-o");
}

ExitCode draw_figure(const FigureKind& kind, const Arguments& arguments, Output& output) {
  const auto options = read_options(arguments);
  if (!options) return fail(output, ExitCode::Usage, options.error());
  if (const auto refused = refused_option(kind, *options))
    return fail(output, ExitCode::Usage, *refused);
  const auto ending = ending_of(arguments, output);
  if (!ending) return fail(output, ExitCode::Usage, ending.error());
  const auto store = arguments.store.open();
  if (!store) return fail(output, exit_code_of_store(store.error()), store.error());
  if (const auto missing = missing_in(**store, *options))
    return fail(output, exit_code_of(*missing), *missing);
  auto figure = kind.make(**store, *options);
  if (!figure) return fail(output, exit_code_of(figure.error()), figure.error());
  const std::size_t points = rows_of_csv(figure->csv);
  const auto bytes = bytes_of(std::move(*figure), *ending, arguments.kind);
  if (!bytes) {
    const bool is_usage = bytes.error().kind == ErrorKind::BadInput;
    return fail(output, is_usage ? ExitCode::Usage : ExitCode::Failed, bytes.error());
  }
  if (arguments.file.empty() || arguments.file == "-") {
    output.out << *bytes;
    return ExitCode::Done;
  }
  if (const auto written = write_whole_file(arguments.file, *bytes); !written)
    return fail(output, ExitCode::Failed, written.error());
  if (output.json) {
    output.out << "{\"figure\":" << json_text(arguments.kind)
               << ",\"file\":" << json_text(arguments.file) << ",\"points\":" << points << "}\n";
  }
  return ExitCode::Done;
}

ExitCode run(const Arguments& arguments, Output& output) {
  if (const FigureKind* kind = find_figure_kind(arguments.kind))
    return draw_figure(*kind, arguments, output);
  output.out << (output.json ? kinds_json() : kinds_text());
  return ExitCode::Done;
}

}  // namespace

Run declare_figure(Options& options) {
  constexpr std::int64_t kLargest = 1'000'000;
  auto arguments = std::make_shared<Arguments>();
  FigureOptions& figure = arguments->options;
  std::vector<std::string> kinds;
  for (const FigureKind& kind : figure_kinds())
    kinds.emplace_back(kind.name);
  options.choice("KIND", arguments->kind, kinds, "What to draw; without it all kinds are told");
  arguments->store.declare(options);
  options.text("-o,--output", arguments->file,
               "Write to this .svg, .pdf, .csv or .tex file (else SVG to standard output)");
  options.text("--width", arguments->width, "Such as 84mm, 17.5cm or 3.3in (default 84mm)");
  options.text("--mission", figure.filter.mission, "Only of this mission");
  options.text("--method", figure.filter.method, "Only of this method");
  options.text("--design", arguments->design, "Only of this design: d3");
  options.text("--candidate", arguments->candidate, "Of this candidate: c812");
  options.integer("--iteration", figure.iteration, {1, kLargest}, "Of this iteration of the race");
  options.choice("--by", figure.by, {"source", "method", "mission"}, "What is compared");
  options.text("--source", figure.source, "Only scores of this source: a profile, real, ...");
  options.text("--parameter", figure.parameter, "Of this parameter: rwm0");
  options.explain(kinds_text());
  return [arguments](Output& output) { return run(*arguments, output); };
}

}  // namespace swarmsmith::cli
