#include "analysis/figures/internal/cell_runs.h"

#include <algorithm>

namespace swarmsmith {
namespace {

using CellState = RacePlot::Cell::State;

/// The common colour of the cells [first, end) of a row.
std::size_t paint_of(const RacePlot::Row& row, std::size_t first, std::size_t end) {
  double sum = 0;
  std::size_t ranked = 0;
  bool is_rejected = false;
  for (std::size_t column = first; column < end; ++column) {
    const RacePlot::Cell& cell = row.cells[column];
    is_rejected = is_rejected || cell.state == CellState::Rejected;
    if (cell.state != CellState::Ranked) continue;
    sum += cell.part;
    ++ranked;
  }
  if (is_rejected) return kRejected;
  if (ranked == 0) return kNotRun;
  const double part = sum / static_cast<double>(ranked);
  return std::min(static_cast<std::size_t>(part * kRankPaints), kRankPaints - 1);
}

std::vector<CellRun> runs_of(const RacePlot& plot, std::size_t steps_a_cell) {
  std::vector<CellRun> runs;
  for (std::size_t row = 0; row < plot.rows.size(); ++row) {
    const RacePlot::Row& cells = plot.rows[row];
    std::size_t alive = plot.steps.size();
    if (cells.dropped_after) alive = *cells.dropped_after + 1;
    for (std::size_t first = 0; first < alive; first += steps_a_cell) {
      const std::size_t end = std::min(first + steps_a_cell, alive);
      const std::size_t paint = paint_of(cells, first, end);
      if (first > 0 && runs.back().paint == paint) {
        runs.back().end = end;
      } else {
        runs.push_back({.row = row, .first = first, .end = end, .paint = paint});
      }
    }
  }
  return runs;
}

}  // namespace

CellRuns cell_runs(const RacePlot& plot, std::size_t most) {
  CellRuns result;
  for (;; ++result.steps_a_cell) {
    result.runs = runs_of(plot, result.steps_a_cell);
    if (result.runs.size() <= most || result.steps_a_cell >= plot.steps.size()) return result;
  }
}

}  // namespace swarmsmith
