#include "analysis/figures/internal/score_groups.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "analysis/figures/internal/panel_grid.h"
#include "base/csv.h"
#include "base/suggestion.h"

namespace swarmsmith {
namespace {

/// Simulations first, robots last, as papers have it.
struct SourceOrder {
  bool operator()(const std::string& a, const std::string& b) const {
    return std::pair(a == "real", a) < std::pair(b == "real", b);
  }
};

/// The names that occur, each with its place.
struct Names {
  std::map<std::string, std::size_t, SourceOrder> sources;
  std::map<std::string, std::size_t> methods;
  std::map<std::string, std::size_t> missions;
  std::set<std::int64_t> designs;

  explicit Names(const std::vector<DesignScore>& scores) {
    for (const DesignScore& score : scores) {
      sources[score.source];
      methods[score.method];
      missions[score.mission];
      designs.insert(score.design.value);
    }
    number(sources);
    number(methods);
    number(missions);
  }

  template <class Map>
  static void number(Map& places) {
    std::size_t next = 0;
    for (auto& place : places)
      place.second = next++;
  }
};

/// What tells groups of a panel apart, outer factor first, so that what is compared is side by
/// side.
std::pair<std::size_t, std::size_t> place_of(const DesignScore& score, const Names& names,
                                             std::string_view by) {
  const std::size_t source = names.sources.at(score.source);
  const std::size_t method = names.methods.at(score.method);
  return by == "method" ? std::pair(source, method) : std::pair(method, source);
}

ScoreGroup group_of(const DesignScore& score, const Names& names, std::string_view by) {
  ScoreGroup group;
  const bool several_methods = names.methods.size() > 1;
  const bool several_sources = names.sources.size() > 1;
  if (by == "mission") {
    group.color = names.missions.at(score.mission);
    group.name = score.mission;
  } else {
    group.color = by == "source" ? names.sources.at(score.source) : names.methods.at(score.method);
    group.name = by == "source" ? score.source : score.method;
  }
  if (several_methods && several_sources) group.name = score.method + " " + score.source;
  if (several_methods && !several_sources) group.name = score.method;
  if (several_sources && !several_methods) group.name = score.source;
  return group;
}

std::string csv_of(const std::vector<DesignScore>& scores) {
  std::string csv =
      "design,mission,method,repetition,candidate,source,purpose,pair,instance,seed,score\n";
  for (const DesignScore& score : scores) {
    csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", score.design.value,
                       csv_field(score.mission), csv_field(score.method), score.repetition,
                       score.candidate.value, csv_field(score.source), score.purpose, score.pair,
                       score.instance, score.seed, score.score);
  }
  return csv;
}

}  // namespace

GroupedScores grouped(const std::vector<DesignScore>& scores, std::string_view by) {
  const Names names(scores);
  GroupedScores result{.by = std::string(by), .csv = csv_of(scores)};
  if (by.empty()) result.by = names.sources.size() > 1 ? "source" : "method";
  std::map<std::string, std::map<std::pair<std::size_t, std::size_t>, ScoreGroup>> panels;
  for (const DesignScore& score : scores) {
    const auto place = place_of(score, names, result.by);
    const auto [found, is_new] = panels[score.mission].try_emplace(place);
    if (is_new) found->second = group_of(score, names, result.by);
    found->second.values.push_back(score.score);
  }
  for (auto& [mission, groups] : panels) {
    result.panels.push_back({.title = as_words(mission)});
    for (auto& place_and_group : groups)
      result.panels.back().groups.push_back(std::move(place_and_group.second));
  }
  result.details = {fmt::format("{} score{} of {} design{}", scores.size(),
                                scores.size() == 1 ? "" : "s", names.designs.size(),
                                names.designs.size() == 1 ? "" : "s")};
  return result;
}

Expected<GroupedScores> grouped_scores(StoreReader& store, const FigureOptions& options) {
  auto scores = design_scores(store, options.filter);
  if (!scores) return Unexpected(scores.error());
  if (scores->empty()) {
    return unexpected(ErrorKind::NotFound,
                      "no finished design of these has a score outside of its race yet; "
                      "`swarmsmith ls designs` shows how far they are");
  }
  if (!options.purpose.empty()) {
    std::erase_if(*scores, [&](const DesignScore& s) { return s.purpose != options.purpose; });
    if (scores->empty()) {
      return unexpected(ErrorKind::NotFound,
                        options.purpose == "test"
                            ? "the winners were not tested by their campaign"
                            : "nobody has scored the winners after their races; `swarmsmith "
                              "evaluate best --store STORE` does");
    }
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
  return grouped(*scores, options.by);
}

}  // namespace swarmsmith
