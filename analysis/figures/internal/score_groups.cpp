#include "analysis/figures/internal/score_groups.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "base/plain_text.h"
#include "base/suggestion.h"
#include "base/text/csv.h"

namespace swarmsmith {
namespace {

/// The key that separates and orders the groups of a panel. The method comes first, so that a
/// method's scores in two sources are side by side, with the source of the campaign's tests first.
std::tuple<std::size_t, bool, std::size_t> band_of(const DesignScore& score,
                                                   const StoreNames& names,
                                                   const std::string& tested) {
  return {place_of(names.methods, score.method), score.source != tested,
          place_of(names.sources, score.source)};
}

/// The source of the campaign's tests; empty if no tests are drawn.
std::string tested_source(const std::vector<DesignScore>& scores) {
  const auto test = std::ranges::find(scores, "test", &DesignScore::purpose);
  return test == scores.end() ? "" : test->source;
}

/// Whether the scores have several methods or several sources.
struct Several {
  bool methods = false;
  bool sources = false;
};

Several several_of(const std::vector<DesignScore>& scores) {
  Several several;
  for (const DesignScore& score : scores) {
    several.methods = several.methods || score.method != scores.front().method;
    several.sources = several.sources || score.source != scores.front().source;
  }
  return several;
}

ScoreGroup group_of(const DesignScore& score, const StoreNames& names, std::string_view by,
                    const Several& several) {
  ScoreGroup group{.method = score.method, .source = score.source};
  if (by == "mission") {
    group.color = place_of(names.missions, score.mission);
    group.name = score.mission;
  } else {
    group.color = by == "source" ? place_of(names.sources, score.source)
                                 : place_of(names.methods, score.method);
    group.name = by == "source" ? score.source : score.method;
  }
  if (several.methods && several.sources) group.name = score.method + " " + score.source;
  if (several.methods && !several.sources) group.name = score.method;
  if (several.sources && !several.methods) group.name = score.source;
  return group;
}

std::size_t designs_in(const std::vector<DesignScore>& scores) {
  std::set<DesignId> designs;
  for (const DesignScore& score : scores)
    designs.insert(score.design);
  return designs.size();
}

std::string csv_of(const std::vector<ScoreValue>& values, ScoreUnit unit) {
  const bool by_run = unit == ScoreUnit::Run;
  std::string csv =
      fmt::format("design,mission,method,repetition,candidate,source,purpose,{},score\n",
                  by_run ? "pair,instance,seed" : "runs");
  for (const auto& [score, runs] : values) {
    csv += fmt::format("{},{},{},{},{},{},{},{},{}\n", score.design.value, csv_field(score.mission),
                       csv_field(score.method), score.repetition, score.candidate.value,
                       csv_field(score.source), score.purpose,
                       by_run ? fmt::format("{},{},{}", score.pair, score.instance, score.seed)
                              : fmt::format("{}", runs.size()),
                       score.score);
  }
  return csv;
}

}  // namespace

GroupedScores grouped(const ChosenScores& taken, const StoreNames& names, std::string_view by) {
  const std::vector<ScoreValue> values = values_of(taken);
  const Several several = several_of(taken.scores);
  GroupedScores result{.by = std::string(by), .csv = csv_of(values, taken.unit)};
  if (by.empty()) result.by = several.sources ? "source" : "method";
  using Place = std::tuple<std::size_t, bool, std::size_t>;
  const std::string tested = tested_source(taken.scores);
  std::map<std::string, std::map<Place, ScoreGroup>> panels;
  for (const ScoreValue& value : values) {
    const Place place = band_of(value.score, names, tested);
    const auto [found, is_new] = panels[value.score.mission].try_emplace(place);
    if (is_new) {
      found->second = group_of(value.score, names, result.by, several);
    }
    found->second.values.push_back(value.score.score);
  }
  for (auto& [mission, groups] : panels) {
    result.panels.push_back({.title = names.title_of(mission)});
    for (auto& place_and_group : groups)
      result.panels.back().groups.push_back(std::move(place_and_group.second));
  }
  const std::size_t designs = designs_in(taken.scores);
  result.details = {counted(taken.scores.size(), "score") + " of " + counted(designs, "design"),
                    taken.said};
  return result;
}

std::string pair_boxes(std::vector<ScorePanel>& panels) {
  if (panels.empty() || panels.front().groups.size() < 2) return "";
  const std::string first = panels.front().groups[0].source;
  const std::string second = panels.front().groups[1].source;
  if (first == second) return "";
  for (const ScorePanel& panel : panels) {
    const std::vector<ScoreGroup>& groups = panel.groups;
    if (groups.size() % 2 != 0) return "";
    for (std::size_t i = 0; i < groups.size(); i += 2) {
      const bool is_pair = groups[i].method == groups[i + 1].method && groups[i].source == first &&
                           groups[i + 1].source == second;
      if (!is_pair) return "";
    }
  }
  for (ScorePanel& panel : panels) {
    for (std::size_t i = 0; i < panel.groups.size(); ++i) {
      panel.groups[i].name = panel.groups[i].method;
      panel.groups[i].narrow = i % 2 == 0;
    }
  }
  return fmt::format("narrow boxes: {}; wide boxes: {}", first, second);
}

Expected<GroupedScores> grouped_scores(StoreReader& store, const FigureOptions& options) {
  auto scores = design_scores(store, options.filter);
  if (!scores) return Unexpected(scores.error());
  if (scores->empty()) {
    return unexpected(ErrorKind::NotFound,
                      "no finished design among these has a score outside of its race yet; "
                      "`swarmsmith ls designs` shows how far they are");
  }
  if (!options.source.empty()) {
    std::set<std::string> sources;
    for (const DesignScore& score : *scores)
      sources.insert(score.source);
    std::erase_if(*scores, [&](const DesignScore& s) { return s.source != options.source; });
    if (scores->empty()) {
      const std::vector<std::string> known(sources.begin(), sources.end());
      return bad_input("no score has the source \"" + options.source + "\"" +
                           did_you_mean(options.source, known) + "; there are: " + joined(known),
                       "--source");
    }
  }
  ChosenScores taken = chosen(std::move(*scores), options.choice);
  if (taken.scores.empty()) {
    return unexpected(ErrorKind::NotFound,
                      options.choice.purpose == "test"
                          ? "the winners were not tested by their campaign"
                          : "the winners have no scores after their races; `swarmsmith evaluate "
                            "best --store STORE` makes them");
  }
  const auto names = names_with_sources(store);
  if (!names) return Unexpected(names.error());
  return grouped(taken, *names, options.by);
}

}  // namespace swarmsmith
