#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "analysis/figures/design_choice.h"
#include "analysis/figures/internal/for_paper.h"
#include "analysis/figures/makers.h"
#include "analysis/figures/race_plot.h"
#include "analysis/records/race_matrix.h"
#include "base/plain_text.h"
#include "base/text/csv.h"

namespace swarmsmith {
namespace {

/// The store's data on one race.
struct Race {
  DesignRecord design;
  IterationRecord iteration;
  RaceMatrix matrix;

  bool has_ended() const {
    return std::ranges::any_of(matrix.rows, [](const auto& row) { return !!row.elite_after; });
  }
};

Expected<Race> read_race(StoreReader& store, const FigureOptions& options) {
  auto design = chosen_design(store, options, "race");
  if (!design) return Unexpected(design.error());
  const DesignId id = design->design;
  const std::string search = search_of(store, id);
  if (!search.empty() && search != "f-race") {
    return bad_input(fmt::format(
        "{} was searched by {}, which has no races to draw; `figure convergence` shows how it went",
        to_string(id), search));
  }
  const auto last = last_raced_iteration(store, id);
  if (!last) return Unexpected(last.error());
  if (*last == 0) {
    return unexpected(ErrorKind::NotFound, fmt::format("{} has not raced yet", to_string(id)));
  }
  const auto all = iterations(store, id);
  if (!all) return Unexpected(all.error());
  const auto record_of = [&](std::int64_t iteration) {
    const auto found = std::ranges::find(*all, iteration, &IterationRecord::iteration);
    return found == all->end() ? IterationRecord{.iteration = iteration} : *found;
  };
  // The requested race, else the last one. The post-selection race at the end is shown only on
  // request.
  const bool is_extra = record_of(*last).postselection && *last > 1;
  const std::int64_t wanted = options.iteration.value_or(is_extra ? *last - 1 : *last);
  auto matrix = race_matrix(store, id, wanted);
  if (!matrix) return Unexpected(matrix.error());
  if (matrix->steps.empty()) {
    return bad_input(fmt::format("--iteration {}: {} has raced the iterations 1 to {}", wanted,
                                 to_string(id), *last));
  }
  return Race{
      .design = std::move(*design), .iteration = record_of(wanted), .matrix = std::move(*matrix)};
}

RacePlot::Row drawn(const RaceMatrix& matrix, const RaceMatrix::Row& row) {
  RacePlot::Row drawn{.name = to_string(row.candidate),
                      .elite_before = row.elite_before.has_value(),
                      .elite_after = row.elite_after.has_value()};
  // A candidate that was only not kept survived to the end of the race.
  if (!row.came_to_the_end()) drawn.dropped_after = row.dropped_after;
  for (std::size_t column = 0; column < matrix.steps.size(); ++column) {
    RacePlot::Cell& cell = drawn.cells.emplace_back();
    const auto [has_run, score, rank] = row.at(column);
    if (rank) {
      const auto others = static_cast<double>(matrix.steps[column].ranked - 1);
      cell = {RacePlot::Cell::State::Ranked, others > 0 ? (*rank - 1) / others : 0};
    } else if (has_run) {
      cell.state = RacePlot::Cell::State::Rejected;
    }
  }
  return drawn;
}

std::string description_of(const Race& race) {
  const auto& [steps, rows] = race.matrix;
  std::string text = fmt::format("Ranks of {} in {} of iteration {} of design {}, best rows first.",
                                 counted(rows.size(), "candidate"), counted(steps.size(), "step"),
                                 race.iteration.iteration, to_string(race.design.design));
  for (const StepRecord& step : steps) {
    if (step.alive_after == step.alive_before) continue;
    text += fmt::format(" Step {} dropped {} and left {}.", step.step,
                        step.alive_before - step.alive_after, step.alive_after);
  }
  if (!rows.empty()) {
    text += fmt::format(" {} came farthest, with the mean rank {:.1f}.",
                        to_string(rows.front().candidate), rows.front().mean_rank);
  }
  return text;
}

std::string csv_of(const Race& race) {
  std::string csv =
      "design,iteration,step,marker,alive_before,alive_after,pair,instance,seed,candidate,"
      "elite_before,elite_after,score,rank,dropped\n";
  const auto maybe = [](const std::optional<double>& value) {
    return value ? fmt::format("{}", *value) : "";
  };
  const auto& [steps, rows] = race.matrix;
  std::vector<const RaceMatrix::Row*> by_number;
  by_number.reserve(rows.size());
  for (const RaceMatrix::Row& row : rows)
    by_number.push_back(&row);
  std::ranges::sort(by_number, {}, &RaceMatrix::Row::candidate);
  for (std::size_t column = 0; column < steps.size(); ++column) {
    const StepRecord& step = steps[column];
    for (const RaceMatrix::Row* row : by_number) {
      const auto [has_run, score, rank] = row->at(column);
      if (!has_run) continue;
      csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", race.design.design.value,
                         step.iteration, step.step, csv_field(step.marker), step.alive_before,
                         step.alive_after, step.pair, step.instance.value_or(0),
                         step.seed.value_or(0), row->candidate.value, row->elite_before ? 1 : 0,
                         row->elite_after ? 1 : 0, maybe(score), maybe(rank),
                         row->dropped_after == column ? csv_field(row->reason) : "");
    }
  }
  return csv;
}

}  // namespace

Expected<Figure> race_figure(StoreReader& store, const FigureOptions& options) {
  const auto race = read_race(store, options);
  if (!race) return Unexpected(race.error());
  const auto& [steps, rows] = race->matrix;
  RacePlot plot{.title = title_of(race->design),
                .description = description_of(*race),
                .width_mm = options.width_mm};
  std::string_view remark;
  if (race->iteration.postselection) remark = " (postselection)";
  if (!race->has_ended())
    remark = race->design.state == "stopped" ? " (stopped)" : " (still running)";
  plot.details.push_back(fmt::format("Race of {}, iteration {}{}", to_string(race->design.design),
                                     race->iteration.iteration, remark));
  // A time budget has no number of experiments.
  plot.details.push_back(race->design.budget > 0
                             ? fmt::format("Budget: {} of the design's {}", race->iteration.budget,
                                           counted(race->design.budget, "experiment"))
                             : "Budget: " + counted(race->iteration.budget, "experiment"));
  plot.details.push_back(fmt::format("{}, {} alive after step {}",
                                     counted(rows.size(), "candidate"), steps.back().alive_after,
                                     steps.back().step));
  for (const StepRecord& step : steps)
    plot.steps.push_back({step.step, step.marker, step.alive_before});
  for (const RaceMatrix::Row& row : rows)
    plot.rows.push_back(drawn(race->matrix, row));
  return Figure{.svg = draw(for_paper(plot, options)), .csv = csv_of(*race), .tex = {}};
}

}  // namespace swarmsmith
