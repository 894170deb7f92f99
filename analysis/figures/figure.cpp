#include "analysis/figures/figure.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "analysis/figures/makers.h"
#include "base/suggestion.h"

namespace swarmsmith {
namespace {

/// Removes and returns the first word of a list separated by blanks.
std::string_view next_word(std::string_view& words) {
  const std::size_t blank = std::min(words.find(' '), words.size());
  const std::string_view word = words.substr(0, blank);
  words.remove_prefix(std::min(blank + 1, words.size()));
  return word;
}

bool has_word(std::string_view words, std::string_view word) {
  while (!words.empty())
    if (next_word(words) == word) return true;
  return false;
}

/// An error for a name that no design of the store has; it lists the existing names.
std::optional<Error> unknown_name(const std::string& given, const char* option,
                                  std::vector<std::string> known) {
  if (given.empty() || std::ranges::find(known, given) != known.end()) return std::nullopt;
  std::ranges::sort(known);
  known.erase(std::unique(known.begin(), known.end()), known.end());
  return Error{ErrorKind::BadInput,
               "the store has no \"" + given + "\"" + did_you_mean(given, known) +
                   "; it has: " + joined(known),
               option};
}

}  // namespace

std::span<const FigureKind> figure_kinds() {
  static constexpr std::array kKinds = {
      FigureKind{"box", "Box plots with points of the winners' scores, one panel per mission",
                 box_figure, "mission method design by source purpose per"},
      FigureKind{"scores", "How often each score occurred, bars of groups side by side",
                 scores_figure, "mission method design by source purpose per"},
      FigureKind{"gap",
                 "What winners lose from their simulator to other sources, one line per design",
                 gap_figure, "mission method design"},
      FigureKind{"training", "Winners' mean scores in the race and in the tests", training_figure,
                 "mission method design"},
      FigureKind{"modules", "How often the winners have each module, as bars and numbers",
                 modules_figure, "mission method"},
      FigureKind{"convergence", "Mean of the elites over the experiments used", convergence_figure,
                 "mission method design"},
      FigureKind{"machine",
                 "Machines, trees, networks: of a design or candidate, else of all winners",
                 machine_figure, "mission method design candidate"},
      FigureKind{"race", "Who raced in an iteration, with ranks and eliminations", race_figure,
                 "mission method design iteration"},
      FigureKind{"sampling", "Values sampled of each parameter, by iteration", sampling_figure,
                 "mission method design parameter"},
      FigureKind{"parallel", "Parameters of the elites among all candidates", parallel_figure,
                 "mission method design parameter"},
      FigureKind{"importance", "How much of the scores' variance each parameter explains",
                 importance_figure, "mission method design"},
      FigureKind{
          "ranks",
          "Mean ranks of methods or sources, with intervals if Friedman's test finds a difference",
          ranks_figure, "mission method by source purpose"},
      FigureKind{"ablation",
                 "Costs on the way from one configuration to another (irace's ablation)",
                 ablation_figure, "design"},
  };
  return kKinds;
}

const FigureKind* find_figure_kind(std::string_view name) {
  const auto kinds = figure_kinds();
  const auto found = std::ranges::find(kinds, name, &FigureKind::name);
  return found == kinds.end() ? nullptr : &*found;
}

std::optional<Error> refused_option(const FigureKind& kind, const FigureOptions& options) {
  const std::array<std::pair<std::string_view, bool>, 11> given = {{
      {"mission", !options.filter.mission.empty()},
      {"method", !options.filter.method.empty()},
      {"design", options.filter.design.has_value()},
      {"by", !options.by.empty()},
      {"source", !options.source.empty()},
      {"purpose", !options.choice.purpose.empty()},
      {"per", options.choice.unit.has_value()},
      {"candidate", options.candidate.has_value()},
      {"iteration", options.iteration.has_value()},
      {"parameter", !options.parameter.empty()},
      {"seed", !options.seeds.empty()},
  }};
  for (const auto& [name, is_given] : given) {
    if (!is_given || has_word(kind.options, name)) continue;
    std::string takes = "--width, --paper";
    for (std::string_view rest = kind.options; !rest.empty();)
      takes += ", --" + std::string(next_word(rest));
    return Error{ErrorKind::BadInput,
                 fmt::format("has no effect on the figure `{}`, which takes {}", kind.name, takes),
                 "--" + std::string(name)};
  }
  return std::nullopt;
}

std::optional<Error> missing_in(StoreReader& store, const FigureOptions& options) {
  const RecordFilter& asked = options.filter;
  if (!asked.mission.empty() || !asked.method.empty()) {
    const auto all = designs(store, {});
    if (!all) return all.error();
    std::vector<std::string> missions;
    std::vector<std::string> methods;
    for (const DesignRecord& design : *all) {
      missions.push_back(design.mission);
      methods.push_back(design.method);
    }
    if (auto error = unknown_name(asked.mission, "--mission", std::move(missions))) return error;
    if (auto error = unknown_name(asked.method, "--method", std::move(methods))) return error;
  }
  if (asked.design) {
    const auto found = designs(store, {.design = asked.design});
    if (!found) return found.error();
    if (found->empty()) {
      return Error{ErrorKind::NotFound, "the store has no design " + to_string(*asked.design),
                   "--design"};
    }
  }
  if (!options.candidate) return std::nullopt;
  const auto found = candidate(store, *options.candidate);
  if (found) return std::nullopt;
  if (found.error().kind != ErrorKind::NotFound) return found.error();
  return Error{ErrorKind::NotFound, "the store has no candidate " + to_string(*options.candidate),
               "--candidate"};
}

}  // namespace swarmsmith
