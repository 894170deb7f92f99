#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "analysis/figures/design_choice.h"
#include "analysis/figures/internal/for_paper.h"
#include "analysis/figures/makers.h"
#include "analysis/figures/race_plot.h"
#include "base/text/csv.h"

namespace swarmsmith {
namespace {

/// What the store has of one race.
struct Race {
  DesignRecord design;
  IterationRecord iteration;
  bool has_ended = false;
  std::vector<StepRecord> steps;
  std::vector<RaceCell> cells;
  std::map<CandidateId, EliminationRecord> dropped;
  std::set<CandidateId> elites_before;
  std::map<CandidateId, std::int64_t> elites_after;  ///< to their rank
};

/// The one that is asked for, else the last; the race of what was left, after that, only when
/// asked.
Expected<std::int64_t> chosen_iteration(const std::vector<StepRecord>& steps,
                                        const std::vector<IterationRecord>& all,
                                        const FigureOptions& options, DesignId design) {
  if (steps.empty()) {
    return unexpected(ErrorKind::NotFound, fmt::format("{} has not raced yet", to_string(design)));
  }
  const std::int64_t last = steps.back().iteration;
  std::int64_t wanted = options.iteration.value_or(last);
  const auto record = std::ranges::find(all, last, &IterationRecord::iteration);
  const bool is_extra = record != all.end() && record->postselection;
  if (!options.iteration && is_extra && last > 1) wanted = last - 1;
  if (std::ranges::find(steps, wanted, &StepRecord::iteration) == steps.end()) {
    return bad_input(fmt::format("--iteration {}: {} has raced the iterations 1 to {}", wanted,
                                 to_string(design), last));
  }
  return wanted;
}

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
  const auto steps = race_steps(store, id);
  if (!steps) return Unexpected(steps.error());
  const auto all = iterations(store, id);
  if (!all) return Unexpected(all.error());
  const auto number = chosen_iteration(*steps, *all, options, id);
  if (!number) return Unexpected(number.error());
  auto cells = race_cells(store, id, *number);
  if (!cells) return Unexpected(cells.error());
  const auto dropped = eliminations(store, id);
  if (!dropped) return Unexpected(dropped.error());
  const auto kept = elites(store, {.design = id});
  if (!kept) return Unexpected(kept.error());

  Race race{.design = std::move(*design), .cells = std::move(*cells)};
  for (const StepRecord& step : *steps)
    if (step.iteration == *number) race.steps.push_back(step);
  for (const EliminationRecord& row : *dropped)
    if (row.iteration == *number) race.dropped.emplace(row.candidate, row);
  for (const EliteRecord& elite : *kept) {
    if (elite.iteration == *number - 1) race.elites_before.insert(elite.candidate);
    if (elite.iteration == *number) race.elites_after.emplace(elite.candidate, elite.rank);
  }
  // The campaign may have stored a step since the steps were read.
  std::erase_if(race.cells, [&](const RaceCell& cell) {
    return std::ranges::find(race.steps, cell.step, &StepRecord::step) == race.steps.end();
  });
  race.has_ended = !race.elites_after.empty();
  const auto iteration = std::ranges::find(*all, *number, &IterationRecord::iteration);
  race.iteration = iteration == all->end() ? IterationRecord{.iteration = *number} : *iteration;
  return race;
}

/// A row and what it is sorted by.
struct Ranked {
  RacePlot::Row row;
  CandidateId candidate;
  bool kept = false;
  std::size_t last_column = 0;
  double rank_sum = 0;
  std::size_t ranked = 0;

  double mean_rank() const {
    return ranked == 0 ? std::numeric_limits<double>::max()
                       : rank_sum / static_cast<double>(ranked);
  }
  /// How far it came, then its mean rank.
  bool operator<(const Ranked& other) const {
    if (kept != other.kept) return kept;
    if (last_column != other.last_column) return last_column > other.last_column;
    if (mean_rank() != other.mean_rank()) return mean_rank() < other.mean_rank();
    return candidate < other.candidate;
  }
};

std::vector<Ranked> rows_of(const Race& race) {
  std::map<std::int64_t, std::size_t> columns;
  std::map<std::int64_t, double> scored;  ///< candidates of a step that have a rank
  for (const StepRecord& step : race.steps)
    columns.emplace(step.step, columns.size());
  for (const RaceCell& cell : race.cells)
    if (cell.rank) ++scored[cell.step];
  std::map<CandidateId, Ranked> rows;
  for (const RaceCell& cell : race.cells) {
    Ranked& row = rows[cell.candidate];
    row.row.cells.resize(race.steps.size());
    const std::size_t column = columns.at(cell.step);
    row.last_column = std::max(row.last_column, column);
    RacePlot::Cell& drawn = row.row.cells[column];
    if (!cell.rank) {
      drawn.state = RacePlot::Cell::State::Rejected;
      continue;
    }
    const double others = scored[cell.step] - 1;
    drawn = {RacePlot::Cell::State::Ranked, others > 0 ? (*cell.rank - 1) / others : 0};
    row.rank_sum += *cell.rank;
    ++row.ranked;
  }
  std::vector<Ranked> sorted;
  for (auto& [candidate, row] : rows) {
    row.candidate = candidate;
    row.row.name = to_string(candidate);
    row.row.elite_before = race.elites_before.contains(candidate);
    row.row.elite_after = race.elites_after.contains(candidate);
    row.kept = row.row.elite_after;
    const auto dropped = race.dropped.find(candidate);
    // Who was only not kept came to the end of the race.
    if (dropped != race.dropped.end() && dropped->second.reason != "not kept") {
      const auto column = columns.find(dropped->second.step);
      if (column != columns.end()) row.row.dropped_after = column->second;
    }
    if (row.row.dropped_after) {
      row.last_column = *row.row.dropped_after;
    } else {
      row.last_column = race.steps.size();
    }
    sorted.push_back(std::move(row));
  }
  std::ranges::sort(sorted, std::less<>());
  return sorted;
}

std::string description_of(const Race& race, const std::vector<Ranked>& rows) {
  std::string text = fmt::format(
      "Ranks of {} candidates in {} steps of iteration {} of design {}, best rows first.",
      rows.size(), race.steps.size(), race.iteration.iteration, to_string(race.design.design));
  for (const StepRecord& step : race.steps) {
    if (step.alive_after == step.alive_before) continue;
    text += fmt::format(" Step {} dropped {} and left {}.", step.step,
                        step.alive_before - step.alive_after, step.alive_after);
  }
  if (!rows.empty()) {
    text += fmt::format(" {} came farthest, with the mean rank {:.1f}.", rows.front().row.name,
                        rows.front().mean_rank());
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
  std::size_t at = 0;
  for (const RaceCell& cell : race.cells) {
    while (race.steps[at].step != cell.step)
      ++at;
    const StepRecord& step = race.steps[at];
    const auto dropped = race.dropped.find(cell.candidate);
    const bool here = dropped != race.dropped.end() && dropped->second.step == cell.step;
    csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", race.design.design.value,
                       step.iteration, step.step, csv_field(step.marker), step.alive_before,
                       step.alive_after, cell.pair, cell.instance, cell.seed, cell.candidate.value,
                       race.elites_before.contains(cell.candidate) ? 1 : 0,
                       race.elites_after.contains(cell.candidate) ? 1 : 0, maybe(cell.score),
                       maybe(cell.rank), here ? csv_field(dropped->second.reason) : "");
  }
  return csv;
}

}  // namespace

Expected<Figure> race_figure(StoreReader& store, const FigureOptions& options) {
  const auto race = read_race(store, options);
  if (!race) return Unexpected(race.error());
  const std::vector<Ranked> rows = rows_of(*race);
  RacePlot plot{.title = title_of(race->design),
                .description = description_of(*race, rows),
                .width_mm = options.width_mm};
  std::string_view remark;
  if (race->iteration.postselection) remark = " (postselection)";
  if (!race->has_ended) remark = " (goes on)";
  plot.details.push_back(fmt::format("Race of {}, iteration {}{}", to_string(race->design.design),
                                     race->iteration.iteration, remark));
  plot.details.push_back(fmt::format("Budget: {} of the design's {} experiments",
                                     race->iteration.budget, race->design.budget));
  plot.details.push_back(fmt::format("{} candidates, {} alive after step {}", rows.size(),
                                     race->steps.back().alive_after, race->steps.back().step));
  for (const StepRecord& step : race->steps)
    plot.steps.push_back({step.step, step.marker, step.alive_before});
  for (const Ranked& row : rows)
    plot.rows.push_back(row.row);
  return Figure{.svg = draw(for_paper(plot, options)), .csv = csv_of(*race), .tex = {}};
}

}  // namespace swarmsmith
