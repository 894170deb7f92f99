#include "cli/commands/figure_arguments.h"

#include <charconv>
#include <utility>

#include "analysis/drawing/svg.h"
#include "cli/arguments/score_words.h"
#include "cli/arguments/thing_id.h"
#include "cli/commands/simulated_figures.h"

namespace swarmsmith::cli {
namespace {

/// The number after `letter` in d3 or c812.
Expected<std::int64_t> number_of(const std::string& text, char letter, const char* option) {
  const auto id = parse_thing_id(text);
  if (id && id->letter == letter) return std::stoll(id->digits);
  const std::string example = letter == 'd' ? "d3" : "c812";
  return bad_input("must be an id such as " + example + ", not \"" + text + "\"", option);
}

/// Seeds of runs that are simulated again.
Expected<std::vector<std::int64_t>> read_seeds(const FigureArguments& arguments) {
  constexpr std::size_t kMostSeeds = 12;
  constexpr std::int64_t kLargest = 2'147'483'647;
  std::vector<std::int64_t> seeds;
  if (arguments.seeds.size() > kMostSeeds)
    return bad_input("at most " + std::to_string(kMostSeeds) + " runs are drawn", "--seed");
  for (const std::string& text : arguments.seeds) {
    std::int64_t seed = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
    const bool is_whole = error == std::errc() && end == text.data() + text.size();
    if (!is_whole || seed < 1 || seed > kLargest)
      return bad_input("wants a number from 1 to 2147483647, not \"" + text + "\"", "--seed");
    seeds.push_back(seed);
  }
  return seeds;
}

}  // namespace

void FigureArguments::declare(Options& words) {
  constexpr std::int64_t kLargest = 1'000'000;
  std::vector<std::string> kinds;
  for (const FigureKind& known : all_figure_kinds())
    kinds.emplace_back(known.name);
  words.choice("KIND", kind, kinds, "What to draw; omit it to list all kinds");
  store.declare(words);
  words.text("-o,--output FILE", file,
             "File to write: .svg, .pdf, .png, .csv or .tex (default: SVG to standard output)");
  words.text("--width WIDTH", width, "Such as 84mm, 17.5cm or 3.3in (default 84mm)");
  words.flag("--paper", options.paper,
             "Leave out title, details and explanations, which a paper has in the caption");
  words.text("--font FONT", font,
             "Font of the texts, which must be installed, such as \"Linux Libertine\"");
  words.text("--mission MISSION", options.filter.mission, "Only this mission");
  words.text("--method METHOD", options.filter.method, "Only this method");
  words.text("--design DESIGN", design, "Only this design: d3");
  words.text("--candidate CANDIDATE", candidate, "Only this candidate: c812");
  words.integer("--iteration", options.iteration, {1, kLargest}, "Iteration of the race");
  words.choice("--by", options.by, {"source", "method", "mission"}, "What to compare");
  words.text("--source SOURCE", options.source, "Only scores of this source: a profile, real, ...");
  words.choice("--purpose", purpose, {"test", "score", "all"}, kPurposeHelp);
  words.choice("--per", per, {"run", "design"}, kPerHelp);
  words.text("--parameter PARAMETER", options.parameter, "Parameter, such as rwm0");
  words.texts("--seed SEED", seeds, "Only runs of this seed; repeatable");
}

std::vector<FigureKind> all_figure_kinds() {
  std::vector<FigureKind> kinds(figure_kinds().begin(), figure_kinds().end());
  const auto simulated = simulated_figures();
  kinds.insert(kinds.end(), simulated.begin(), simulated.end());
  return kinds;
}

Expected<FigureOptions> read_options(const FigureArguments& arguments) {
  FigureOptions options = arguments.options;
  options.choice = score_choice(arguments.purpose, arguments.per);
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
  auto seeds = read_seeds(arguments);
  if (!seeds) return Unexpected(seeds.error());
  options.seeds = std::move(*seeds);
  if (arguments.width.empty()) return options;
  options.width_mm = millimetres_from_text(arguments.width);
  if (options.width_mm >= kLeastFigureWidth_mm && options.width_mm <= kMostFigureWidth_mm)
    return options;
  return bad_input("a figure is 60mm to 1000mm wide (also cm, in), not \"" + arguments.width + "\"",
                   "--width");
}

}  // namespace swarmsmith::cli
