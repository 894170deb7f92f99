#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analysis/records/records.h"

namespace swarmsmith {

/// One race of a design, for all that show it: a column a step, a row a candidate.
struct RaceMatrix {
  struct Step : StepRecord {
    std::int64_t ranked = 0;  ///< candidates with a rank
  };
  struct Cell {
    bool has_run = false;
    std::optional<double> score{};  ///< none when rejected
    std::optional<double> rank{};   ///< 1 is best, ties share their mean
  };
  struct Row {
    CandidateId candidate;
    std::optional<std::int64_t> elite_before{};  ///< rank among the elites before the iteration
    std::optional<std::int64_t> elite_after{};
    std::optional<std::size_t> dropped_after{};  ///< column
    std::string reason{};                        ///< v_eliminations.reason
    double mean_rank = 0;                        ///< infinite without a rank
    std::vector<Cell> cells{};                   ///< by column; empty ones at the end are left out

    /// It survived all tests; the best of these are the elites, the others are "not kept".
    bool came_to_the_end() const { return !dropped_after || reason == "not kept"; }
    Cell at(std::size_t column) const { return column < cells.size() ? cells[column] : Cell{}; }
  };

  std::vector<Step> steps;
  /// Those that came further first: elites by rank, the others by the step that dropped them;
  /// equals by their mean rank, then by their number.
  std::vector<Row> rows;
};

/// Empty when the iteration has no step yet. A step that a campaign stores meanwhile is left out.
Expected<RaceMatrix> race_matrix(StoreReader& store, DesignId design, std::int64_t iteration);

}  // namespace swarmsmith
