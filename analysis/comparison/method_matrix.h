#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/comparison/comparison.h"
#include "base/text/json.h"

namespace swarmsmith {

/// Which method wins where, by how much, and how sure that is: methods by missions, one such matrix
/// a source. Made of a comparison by method.
struct MethodMatrix {
  struct Cell {
    std::size_t n = 0;     ///< values: designs or runs
    std::size_t runs = 0;  ///< behind them
    double mean = 0;
    std::optional<double> half_width;  ///< of Student's 95 % interval; none of one value
    double rank = 0;                   ///< of the mean in its mission, 1 is best; ties share theirs
    /// Methods of a mission that share a letter do not differ at 5 % by the rank-sum tests of all
    /// its pairs with Holm's correction. Empty where there is one method.
    std::string letters;
    double behind = 0;               ///< the mission's best mean - this one
    std::optional<double> p_behind;  ///< of the test against that method, corrected
  };
  struct Row {
    std::string method;
    std::optional<double> mean_rank;  ///< over the missions; none where it lacks one
    std::vector<std::optional<Cell>> cells;
  };

  std::string source;
  std::vector<std::string> missions;
  std::vector<Row> rows;  ///< the best mean rank first, then by name
};

std::vector<MethodMatrix> method_matrices(const Comparison& comparison);

/// What one should know before believing the letters: the comparison's notes but those of ranks,
/// and where values are too few for any other letters.
std::vector<std::string> matrix_notes(const Comparison& comparison);

/// Which of `count` things do not differ, in letters: two differ exactly when they share none.
/// `different[i][j]`; they are lettered in their order. Source: Piepho 2004, Journal of
/// Computational and Graphical Statistics 13(2), insert and absorb.
std::vector<std::string> letters_of(const std::vector<std::vector<bool>>& different);

/// For people: a table a source, and how to read it.
std::string matrices_text(const Comparison& comparison);
/// A row a cell, full precision: docs/statistics.md.
std::string matrices_csv(const Comparison& comparison);
JsonPiece matrices_json(const Comparison& comparison);

}  // namespace swarmsmith
