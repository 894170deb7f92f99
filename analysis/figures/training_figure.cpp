#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "analysis/figures/internal/for_paper.h"
#include "analysis/figures/internal/store_names.h"
#include "analysis/figures/makers.h"
#include "analysis/figures/scatter_plot.h"
#include "analysis/records/chosen_scores.h"
#include "base/plain_text.h"
#include "base/text/csv.h"

namespace swarmsmith {
namespace {

/// A winner, with its scores in its race and in its tests.
struct Trained {
  DesignRecord design;
  ScoreValue tests;
};

/// Only designs with races: baselines were not trained.
std::vector<Trained> trained(std::vector<DesignRecord> all, const std::vector<ScoreValue>& values) {
  std::vector<Trained> winners;
  for (DesignRecord& design : all) {
    if (!design.best || !design.best_mean || design.used == 0) continue;
    const auto tests = std::ranges::find_if(values, [&](const ScoreValue& value) {
      return value.score.design == design.design && value.score.candidate == *design.best;
    });
    if (tests != values.end()) winners.push_back({std::move(design), *tests});
  }
  return winners;
}

std::string csv_of(const std::vector<Trained>& winners) {
  std::string csv =
      "design,mission,method,repetition,candidate,race_mean,source,test_runs,test_mean,change\n";
  for (const auto& [design, tests] : winners) {
    csv += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", design.design.value,
                       csv_field(design.mission), csv_field(design.method), design.repetition,
                       design.best->value, *design.best_mean, csv_field(tests.score.source),
                       tests.runs.size(), tests.score.score, tests.score.score - *design.best_mean);
  }
  return csv;
}

}  // namespace

Expected<Figure> training_figure(StoreReader& store, const FigureOptions& options) {
  auto all = designs(store, options.filter);
  if (!all) return Unexpected(all.error());
  auto scores = design_scores(store, options.filter);
  if (!scores) return Unexpected(scores.error());
  const auto names = names_of(store);
  if (!names) return Unexpected(names.error());
  const ChosenScores taken =
      chosen(std::move(*scores), {.purpose = "test", .unit = ScoreUnit::Design});
  const std::vector<Trained> winners = trained(std::move(*all), values_of(taken));
  if (winners.empty()) {
    return unexpected(ErrorKind::NotFound,
                      "no winner of a race has tests yet; `swarmsmith ls designs` shows how far "
                      "they are");
  }
  ScatterPlot plot{.title = "Training and test",
                   .details = {counted(winners.size(), "winner") + "; dashed: the same in both",
                               "below the line: worse on fresh seeds than in the race"},
                   .horizontal = "mean score in the race",
                   .vertical = "mean score in the tests (higher is better)",
                   .width_mm = options.width_mm};
  std::map<std::size_t, ScatterPlot::Panel> panels;
  std::map<std::size_t, std::string> methods;
  for (const auto& [design, tests] : winners) {
    ScatterPlot::Panel& panel = panels[place_of(names->missions, design.mission)];
    panel.title = names->title_of(design.mission);
    const std::size_t color = place_of(names->methods, design.method);
    methods.emplace(color, design.method);
    panel.points.push_back({*design.best_mean, tests.score.score, color});
  }
  for (auto& [place, panel] : panels)
    plot.panels.push_back(std::move(panel));
  plot.groups.assign(methods.begin(), methods.end());
  return Figure{.svg = draw(for_paper(plot, options)), .csv = csv_of(winners), .tex = {}};
}

}  // namespace swarmsmith
