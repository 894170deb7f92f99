#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "analysis/drawing/axes.h"
#include "analysis/drawing/figure_style.h"
#include "analysis/figures/box_plot.h"
#include "analysis/figures/internal/for_paper.h"
#include "analysis/figures/internal/score_groups.h"
#include "analysis/figures/internal/store_names.h"
#include "analysis/figures/makers.h"
#include "analysis/records/chosen_scores.h"
#include "analysis/records/names.h"
#include "analysis/statistics/summary.h"
#include "analysis/statistics/wilcoxon.h"
#include "base/text/csv.h"

namespace swarmsmith {
namespace {

constexpr std::size_t kMostTests = 6;  ///< further tests are only in the table

/// The designs of a mission and method that have a score in each source.
struct GapGroup {
  std::string mission;
  std::string method;
  /// By design: one mean per source, NaN if there is none.
  std::map<DesignId, std::vector<ScoreValue>> designs;
};

/// The key is the indices of mission and method in the store's names.
using GapGroups = std::map<std::pair<std::size_t, std::size_t>, GapGroup>;

/// The source in which designs were raced comes first.
std::vector<std::string> sources_of(const std::vector<ScoreValue>& values,
                                    const StoreNames& names) {
  std::vector<std::string> sources;
  for (const std::string& source : names.sources) {
    const bool is_drawn = std::ranges::any_of(
        values, [&](const ScoreValue& value) { return value.score.source == source; });
    if (is_drawn) sources.push_back(source);
  }
  const auto tested = std::ranges::find_if(
      values, [](const ScoreValue& value) { return value.score.purpose == "test"; });
  if (tested == values.end()) return sources;
  const auto own = std::ranges::find(sources, tested->score.source);
  std::rotate(sources.begin(), own, own + 1);
  return sources;
}

GapGroups grouped_by_method(const std::vector<ScoreValue>& values, const StoreNames& names) {
  GapGroups groups;
  for (const ScoreValue& value : values) {
    GapGroup& group = groups[{place_of(names.missions, value.score.mission),
                              place_of(names.methods, value.score.method)}];
    group.mission = value.score.mission;
    group.method = value.score.method;
    group.designs[value.score.design].push_back(value);
  }
  return groups;
}

const ScoreValue* in_source(const std::vector<ScoreValue>& values, const std::string& source) {
  const auto found = std::ranges::find_if(
      values, [&](const ScoreValue& value) { return value.score.source == source; });
  return found == values.end() ? nullptr : &*found;
}

/// Boxes of one method, one per source, and one line per design between them.
void add_boxes(ScorePanel& panel, const GapGroup& group, const std::vector<std::string>& sources,
               const StoreNames& names, bool several_methods) {
  std::map<DesignId, ScoreLink> open;
  for (const std::string& source : sources) {
    ScoreGroup box{.name = several_methods ? group.method + " " + source : source,
                   .color = place_of(names.sources, source),
                   .method = group.method,
                   .source = source};
    for (const auto& [design, values] : group.designs) {
      const ScoreValue* value = in_source(values, source);
      if (value == nullptr) continue;
      const ScoreLink here{.from = panel.groups.size(), .from_value = box.values.size()};
      box.values.push_back(value->score.score);
      if (const auto before = open.find(design); before != open.end()) {
        ScoreLink link = before->second;
        link.to = here.from;
        link.to_value = here.from_value;
        panel.links.push_back(link);
      }
      open[design] = here;
    }
    if (!box.values.empty()) panel.groups.push_back(std::move(box));
  }
}

std::vector<std::string> tests_of(const GapGroup& group, const std::vector<std::string>& sources) {
  std::vector<std::string> lines;
  for (std::size_t s = 1; s < sources.size(); ++s) {
    std::vector<double> first;
    std::vector<double> other;
    for (const auto& [design, values] : group.designs) {
      const ScoreValue* a = in_source(values, sources[0]);
      const ScoreValue* b = in_source(values, sources[s]);
      if (a == nullptr || b == nullptr) continue;
      first.push_back(a->score.score);
      other.push_back(b->score.score);
    }
    if (first.empty()) continue;
    const WilcoxonTest test = signed_rank_test(first, other);
    const double change = mean_of(other) - mean_of(first);
    std::string found = test.p_value ? fmt::format("Wilcoxon p = {:.3g}", *test.p_value)
                                     : std::string("no differences to test");
    if (test.p_value && test.least_p >= kTestLevel) found = "too few for a test";
    lines.push_back(fmt::format(
        "{}, {}: {} to {}, mean change {}, {}, n = {}", as_words(group.mission), group.method,
        sources[0], sources[s],
        std::abs(change) < 1000 ? fmt::format("{:+.3g}", change) : fmt::format("{:+.0f}", change),
        found, first.size()));
  }
  return lines;
}

/// "runs a design: rvr 100, pseudo-reality 1". Means of few runs vary more, so the numbers are
/// shown.
std::string runs_text(const std::vector<ScoreValue>& values,
                      const std::vector<std::string>& sources) {
  std::string text = "runs a design: ";
  for (std::size_t s = 0; s < sources.size(); ++s) {
    std::size_t least = 0;
    std::size_t most = 0;
    for (const ScoreValue& value : values) {
      if (value.score.source != sources[s]) continue;
      least = least == 0 ? value.runs.size() : std::min(least, value.runs.size());
      most = std::max(most, value.runs.size());
    }
    text += fmt::format("{}{} {}", s == 0 ? "" : ", ", sources[s], least);
    if (most > least) text += fmt::format(" to {}", most);
  }
  return text;
}

std::string csv_of(const GapGroups& groups, const std::vector<std::string>& sources) {
  std::string csv =
      "mission,method,design,repetition,source,runs,mean,reference_source,reference_mean,change\n";
  for (const auto& [place, group] : groups) {
    for (const auto& [design, values] : group.designs) {
      const ScoreValue* reference = in_source(values, sources[0]);
      for (const std::string& source : sources) {
        const ScoreValue* value = in_source(values, source);
        if (value == nullptr) continue;
        csv += fmt::format("{},{},{},{},{},{},{}", csv_field(group.mission),
                           csv_field(group.method), design.value, value->score.repetition,
                           csv_field(source), value->runs.size(), value->score.score);
        csv += reference == nullptr
                   ? std::string(",,,\n")
                   : fmt::format(",{},{},{}\n", csv_field(sources[0]), reference->score.score,
                                 value->score.score - reference->score.score);
      }
    }
  }
  return csv;
}

}  // namespace

Expected<Figure> gap_figure(StoreReader& store, const FigureOptions& options) {
  auto scores = design_scores(store, options.filter);
  if (!scores) return Unexpected(scores.error());
  const auto names = names_with_sources(store);
  if (!names) return Unexpected(names.error());
  const ChosenScores taken = chosen(std::move(*scores), {.purpose = {}, .unit = ScoreUnit::Design});
  const std::vector<ScoreValue> values = values_of(taken);
  const std::vector<std::string> sources = sources_of(values, *names);
  if (sources.size() < 2) {
    return unexpected(ErrorKind::NotFound,
                      "the winners have scores of " +
                          (sources.empty() ? std::string("no source")
                                           : "one source alone (" + sources.front() + ")") +
                          "; `[tests] profiles` of a campaign file adds those of another on the "
                          "same seeds, `swarmsmith evaluate best --profile pseudo-reality --store "
                          "STORE` on others");
  }
  const GapGroups groups = grouped_by_method(values, *names);
  BoxPlot plot{
      .title = "From " + sources.front() + " to other sources",
      .details = {taken.said + "; lines join the values of one design", runs_text(values, sources)},
      .width_mm = options.width_mm};
  for (std::size_t s = 1; s < sources.size(); ++s) {
    if (auto note = seeds_differ(taken.scores, sources[0], sources[s]))
      plot.details.push_back(std::move(*note));
  }
  std::map<std::string, std::size_t> methods;
  for (const auto& [place, group] : groups)
    ++methods[group.method];
  std::vector<std::string> tests;
  std::size_t mission = names->missions.size();
  for (const auto& [place, group] : groups) {
    if (plot.panels.empty() || place.first != mission) {
      plot.panels.push_back({.title = names->title_of(group.mission)});
      mission = place.first;
    }
    add_boxes(plot.panels.back(), group, sources, *names, methods.size() > 1);
    for (std::string& line : tests_of(group, sources))
      tests.push_back(std::move(line));
  }
  if (tests.size() <= kMostTests)
    plot.details.insert(plot.details.end(), tests.begin(), tests.end());
  std::vector<std::string> lines;
  for (const std::string& detail : plot.details) {
    for (std::string& line :
         broken_text(detail, kTextSize, options.width_mm - 2 * kMargin, kMostTests))
      lines.push_back(std::move(line));
  }
  plot.details = std::move(lines);
  if (methods.size() > 1) plot.legend = pair_boxes(plot.panels);
  return Figure{.svg = draw(for_paper(plot, options)), .csv = csv_of(groups, sources), .tex = {}};
}

}  // namespace swarmsmith
