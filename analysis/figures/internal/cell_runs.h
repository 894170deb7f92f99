#pragma once

#include <cstddef>
#include <vector>

#include "analysis/figures/race_plot.h"

namespace swarmsmith {

/// Cells of a row, side by side, that are painted alike.
struct CellRun {
  std::size_t row = 0;
  std::size_t first = 0;  ///< column
  std::size_t end = 0;    ///< one past the last column
  std::size_t paint = 0;  ///< below kRankPaints a colour of ranks, 0 the best; or the two below
};

inline constexpr std::size_t kRankPaints = 7;
inline constexpr std::size_t kNotRun = kRankPaints;  ///< alive, and no score
inline constexpr std::size_t kRejected = kRankPaints + 1;
inline constexpr std::size_t kPaints = kRankPaints + 2;

struct CellRuns {
  std::size_t steps_a_cell = 1;
  std::vector<CellRun> runs;  ///< row by row, from the left
};

/// At most `most` runs (or one column alone): `steps_a_cell` neighbouring steps share the cell of
/// their mean rank, as few as do.
CellRuns cell_runs(const RacePlot& plot, std::size_t most);

}  // namespace swarmsmith
