#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analysis/records/records.h"

namespace swarmsmith {

/// One race of a design, for everything that displays it: one column per step, one row per
/// candidate.
struct RaceMatrix {
  struct Step : StepRecord {
    std::int64_t ranked = 0;  ///< number of candidates with a rank
  };
  struct Cell {
    bool has_run = false;
    std::optional<double> score{};  ///< empty if rejected
    std::optional<double> rank{};   ///< 1 is best; ties share their mean rank
  };
  struct Row {
    CandidateId candidate;
    std::optional<std::int64_t> elite_before{};  ///< rank among the elites before the iteration
    std::optional<std::int64_t> elite_after{};
    std::optional<std::size_t> dropped_after{};  ///< column
    std::string reason{};                        ///< v_eliminations.reason
    double mean_rank = 0;                        ///< infinite if it has no ranks
    std::vector<Cell> cells{};                   ///< by column; without empty cells at the end

    /// The candidate survived all tests. The best of these candidates become elites; the others are
    /// "not kept".
    bool came_to_the_end() const { return !dropped_after || reason == "not kept"; }
    Cell at(std::size_t column) const { return column < cells.size() ? cells[column] : Cell{}; }
  };

  std::vector<Step> steps;
  /// Candidates that survived longer come first: elites by rank, others by the step that dropped
  /// them; ties by mean rank, then by number.
  std::vector<Row> rows;
};

/// Empty if the iteration has no step yet. Leaves out a step that a campaign stores in the
/// meantime.
Expected<RaceMatrix> race_matrix(StoreReader& store, DesignId design, std::int64_t iteration);

}  // namespace swarmsmith
