#pragma once

#include <cstddef>
#include <vector>

#include "analysis/figures/race_plot.h"

namespace swarmsmith {

/// Neighbouring cells of a row that have the same colour.
struct CellRun {
  std::size_t row = 0;
  std::size_t first = 0;  ///< column
  std::size_t end = 0;    ///< one past the last column
  std::size_t paint = 0;  ///< below kRankPaints: a colour for ranks, 0 is the best; else one of the
                          ///< two constants below
};

inline constexpr std::size_t kRankPaints = 7;
inline constexpr std::size_t kNotRun = kRankPaints;  ///< alive, but without a score
inline constexpr std::size_t kRejected = kRankPaints + 1;
inline constexpr std::size_t kPaints = kRankPaints + 2;

struct CellRuns {
  std::size_t steps_a_cell = 1;
  std::vector<CellRun> runs;  ///< row by row, from left to right
};

/// At most `most` runs, or a single column. To achieve this, `steps_a_cell` neighbouring steps
/// share one cell with their mean rank; that number is as small as possible.
CellRuns cell_runs(const RacePlot& plot, std::size_t most);

}  // namespace swarmsmith
