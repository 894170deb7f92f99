#include "analysis/records/race_matrix.h"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

namespace swarmsmith {
namespace {

double mean_rank_of(const RaceMatrix::Row& row) {
  double sum = 0;
  std::size_t ranked = 0;
  for (const RaceMatrix::Cell& cell : row.cells) {
    if (!cell.rank) continue;
    sum += *cell.rank;
    ++ranked;
  }
  return ranked == 0 ? std::numeric_limits<double>::infinity() : sum / static_cast<double>(ranked);
}

auto order_of(const RaceMatrix::Row& row) {
  constexpr std::int64_t kLast = std::numeric_limits<std::int64_t>::max();
  std::int64_t came = kLast;
  if (row.dropped_after) {
    came = row.came_to_the_end() ? kLast - 1 : static_cast<std::int64_t>(*row.dropped_after);
  }
  return std::tuple(-came, row.elite_after.value_or(kLast), row.mean_rank, row.candidate);
}

}  // namespace

Expected<RaceMatrix> race_matrix(StoreReader& store, DesignId design, std::int64_t iteration) {
  const auto steps = race_steps(store, design, iteration);
  if (!steps) return Unexpected(steps.error());
  const auto cells = race_cells(store, design, iteration);
  if (!cells) return Unexpected(cells.error());
  const auto dropped = eliminations(store, design, iteration);
  if (!dropped) return Unexpected(dropped.error());
  const auto kept = elites(store, {.design = design});
  if (!kept) return Unexpected(kept.error());

  RaceMatrix matrix;
  std::map<std::int64_t, std::size_t> columns;
  for (const StepRecord& step : *steps) {
    columns.emplace(step.step, matrix.steps.size());
    matrix.steps.push_back({step});
  }
  std::map<CandidateId, RaceMatrix::Row> rows;
  for (const RaceCell& cell : *cells) {
    const auto column = columns.find(cell.step);
    if (column == columns.end()) continue;
    if (cell.rank) ++matrix.steps[column->second].ranked;
    RaceMatrix::Row& row = rows[cell.candidate];
    // Cells come in the order of steps, so this never cuts off a cell.
    row.cells.resize(column->second + 1);
    row.cells.back() = {.has_run = true, .score = cell.score, .rank = cell.rank};
  }
  for (const EliminationRecord& drop : *dropped) {
    const auto row = rows.find(drop.candidate);
    const auto column = columns.find(drop.step);
    if (row == rows.end() || column == columns.end()) continue;
    row->second.dropped_after = column->second;
    row->second.reason = drop.reason;
  }
  for (const EliteRecord& elite : *kept) {
    const auto row = rows.find(elite.candidate);
    if (row == rows.end()) continue;
    if (elite.iteration == iteration - 1) row->second.elite_before = elite.rank;
    if (elite.iteration == iteration) row->second.elite_after = elite.rank;
  }
  for (auto& [candidate, row] : rows) {
    row.candidate = candidate;
    row.mean_rank = mean_rank_of(row);
    matrix.rows.push_back(std::move(row));
  }
  std::ranges::sort(matrix.rows, {}, order_of);
  return matrix;
}

}  // namespace swarmsmith
