#include "analysis/comparison/comparison.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "analysis/comparison/internal/score_table.h"
#include "analysis/statistics/multiple_tests.h"

namespace swarmsmith {
namespace {

void add_groups(const ScoreTable& table, Comparison& comparison) {
  for (const auto& [key, designs] : table) {
    ComparedGroup group{.mission = key.mission,
                        .method = key.method,
                        .source = key.source,
                        .designs = designs.size(),
                        .values = values_of(designs, comparison.unit)};
    for (const auto& [id, design] : designs)
      group.runs += design.scores.size();
    group.summary = summary_of(group.values);
    comparison.groups.push_back(std::move(group));
  }
}

void adjust_p_values(std::vector<ComparedPair>& pairs) {
  std::vector<std::optional<double>> p_values;
  p_values.reserve(pairs.size());
  for (const ComparedPair& pair : pairs)
    p_values.push_back(pair.test.p_value);
  const auto adjusted = holm_adjusted(p_values);
  for (std::size_t i = 0; i < pairs.size(); ++i)
    pairs[i].p_holm = adjusted[i];
  double least_p = 1;
  for (const ComparedPair& pair : pairs)
    if (pair.test.p_value) least_p = std::min(least_p, pair.test.least_p);
  const auto note = hopeless(corrected_tests(pairs), least_p);
  // A pair that is too small on its own has a note about that already.
  for (ComparedPair& pair : pairs)
    if (note && pair.test.p_value && pair.test.least_p < kTestLevel) pair.notes.push_back(*note);
}

/// Sources are compared on the same designs, so that only the source should differ; notes different
/// seeds.
void note_seeds(const std::vector<DesignScore>& scores, Comparison& comparison) {
  if (comparison.unit == ScoreUnit::Run) return;  // only runs on the same seed are paired
  std::set<std::pair<std::string, std::string>> known;
  for (ComparedPair& pair : comparison.pairs) {
    std::vector<DesignScore> of_pair = scores;
    std::erase_if(of_pair, [&](const DesignScore& score) {
      return score.mission != pair.mission || score.method != pair.method;
    });
    if (auto note = seeds_differ(of_pair, pair.first, pair.second))
      pair.notes.push_back(std::move(*note));
    if (!known.insert({pair.first, pair.second}).second) continue;
    if (auto note = seeds_differ(scores, pair.first, pair.second))
      comparison.seeds.push_back(std::move(*note));
  }
}

/// Notes that there is nothing to compare, and why.
void note_lonely(const ScoreTable& table, Comparison& comparison) {
  const bool by_source = comparison.options.by == CompareBy::Source;
  const auto names = names_in(table, by_source ? &GroupKey::source : &GroupKey::method);
  if (names.size() != 1) return;
  const bool has_methods = by_source && names_in(table, &GroupKey::method).size() > 1;
  comparison.unranked.push_back(
      fmt::format("all scores have the same {} {}: there is nothing to compare{}",
                  by_source ? "source" : "method", *names.begin(),
                  has_methods ? "; its methods differ: compare by method" : ""));
  comparison.notes.push_back(comparison.unranked.back());
}

/// Notes methods that used much less than their budget, or more since they were extended.
/// `commands`: of users, to the campaigns.
void note_unused_budgets(const std::vector<DesignRecord>& all,
                         const std::vector<CommandRow>& commands, Comparison& comparison) {
  constexpr double kNearlyAll = 0.95;
  struct Runs {
    std::int64_t used = 0;
    std::int64_t budget = 0;
    double share() const { return static_cast<double>(used) / static_cast<double>(budget); }
  };
  std::map<DesignId, std::int64_t> extensions;
  for (const CommandRow& command : commands) {
    if (command.kind == CommandKind::Extend && command.step)
      extensions[command.design] += command.budget;
  }
  std::map<std::string, Runs> methods;
  for (const DesignRecord& design : all) {
    const bool is_compared =
        std::ranges::any_of(comparison.groups, [&](const ComparedGroup& group) {
          return group.method == design.method && group.mission == design.mission;
        });
    if (!is_compared || design.state != "finished" || design.budget == 0) continue;
    methods[design.method].used += design.used;
    // Without extensions: a method that was extended had more than the others.
    methods[design.method].budget += design.budget - extensions[design.design];
  }
  if (methods.size() < 2) return;
  for (const auto& [method, runs] : methods) {
    if (runs.share() >= kNearlyAll && runs.share() <= 1) continue;
    comparison.notes.push_back(fmt::format(
        "{} used {:.0f} % of its experiments ({} of {}){}: compare with what the others used",
        method, 100 * runs.share(), runs.used, runs.budget,
        runs.share() > 1 ? ", since it was extended" : ""));
  }
}

void note_runs(Comparison& comparison) {
  if (comparison.unit != ScoreUnit::Run || comparison.pairs.empty()) return;
  const auto& groups = comparison.groups;
  const bool several_runs = std::ranges::any_of(
      groups, [](const ComparedGroup& group) { return group.runs > group.designs; });
  const bool several_designs =
      std::ranges::any_of(groups, [](const ComparedGroup& group) { return group.designs > 1; });
  if (!several_designs) {
    comparison.notes.emplace_back(
        "each group is one design: these tests tell machines apart, and say nothing about the "
        "methods that made them");
  } else if (several_runs) {
    comparison.notes.emplace_back(
        "runs of one design are not independent of each other: these tests overstate the "
        "certainty");
  }
}

template <class Part>
std::string names_of(const std::vector<DesignScore>& scores, const Part& part) {
  std::set<std::string> names;
  for (const DesignScore& score : scores)
    names.insert(std::invoke(part, score));
  return fmt::format("{}", fmt::join(names, ", "));
}

template <class Part>
bool has(const std::vector<DesignScore>& scores, const Part& part, const std::string& name) {
  return name.empty() || std::ranges::any_of(scores, [&](const DesignScore& score) {
           return std::invoke(part, score) == name;
         });
}

/// An error if the options name something that does not exist; checks each name, then the whole
/// selection.
std::optional<Error> missing(const std::vector<DesignScore>& scores,
                             const ComparisonOptions& options) {
  const auto error = [](std::string message, std::string where) {
    return Error{ErrorKind::NotFound, std::move(message), std::move(where)};
  };
  if (scores.empty()) {
    return error(
        "no finished design has scores of its winner; `swarmsmith ls designs` shows how far they "
        "are. Scores come from test instances of a mission, or from `swarmsmith evaluate`",
        "");
  }
  const auto lacks = [&](std::string_view what, auto part,
                         const std::string& name) -> std::optional<Error> {
    if (has(scores, part, name)) return std::nullopt;
    return error(fmt::format("there are no scores of {} `{}`; there are {}", what, name,
                             names_of(scores, part)),
                 fmt::format("--{}", what));
  };
  for (const std::string& mission : options.missions) {
    if (auto found = lacks("mission", &DesignScore::mission, mission)) return found;
  }
  if (auto found = lacks("method", &DesignScore::method, options.method)) return found;
  if (auto found = lacks("source", &DesignScore::source, options.source)) return found;
  const std::string& purpose = options.choice.purpose;
  if (purpose != "all") {
    if (auto found = lacks("purpose", &DesignScore::purpose, purpose)) return found;
  }
  if (wanted(scores, options).scores.empty())
    return error("no score matches the given mission, method, source and purpose", "");
  return std::nullopt;
}

}  // namespace

std::size_t corrected_tests(const std::vector<ComparedPair>& pairs) {
  return static_cast<std::size_t>(std::ranges::count_if(
      pairs, [](const ComparedPair& pair) { return pair.test.p_value.has_value(); }));
}

std::optional<std::string> hopeless(std::size_t tests, double least_p) {
  // Holm multiplies the smallest p by the number of tests, and no adjusted p is below that one.
  const double least = std::min(1.0, static_cast<double>(tests) * least_p);
  if (tests < 2 || least < kTestLevel) return std::nullopt;
  return fmt::format(
      "too few values for {} tests together: after the correction even the clearest difference "
      "would have a p of {:.3g}",
      tests, least);
}

Comparison compare(const std::vector<DesignScore>& scores, const ComparisonOptions& options) {
  ChosenScores taken = wanted(scores, options);
  const ScoreTable table = score_table(taken.scores);
  Comparison comparison{.options = options, .unit = taken.unit, .said = std::move(taken.said)};
  const auto test = std::ranges::find(taken.scores, "test", &DesignScore::purpose);
  if (test != taken.scores.end()) comparison.tested = test->source;
  add_groups(table, comparison);
  switch (options.by) {
    case CompareBy::Source:
      add_source_pairs(table, comparison);
      add_source_ranks(table, comparison);
      note_seeds(taken.scores, comparison);
      note_lonely(table, comparison);
      break;
    case CompareBy::Method:
      add_method_pairs(table, comparison);
      add_method_ranks(table, comparison);
      note_lonely(table, comparison);
      break;
    case CompareBy::Mission:
      comparison.notes.emplace_back(
          "scores of different missions have different units: they are not compared");
      break;
  }
  adjust_p_values(comparison.pairs);
  note_runs(comparison);
  return comparison;
}

Expected<Comparison> compare(StoreReader& store, const ComparisonOptions& options) {
  const auto scores = design_scores(store, {});
  if (!scores) return Unexpected(scores.error());
  if (auto error = missing(*scores, options)) return Unexpected(std::move(*error));
  return compare(store, *scores, options);
}

Expected<Comparison> compare(StoreReader& store, const std::vector<DesignScore>& scores,
                             const ComparisonOptions& options) {
  Comparison comparison = compare(scores, options);
  if (options.by == CompareBy::Method) {
    const auto all = designs(store, {});
    if (!all) return Unexpected(all.error());
    note_unused_budgets(*all, store.commands(), comparison);
  }
  return comparison;
}

}  // namespace swarmsmith
