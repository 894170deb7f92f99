#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/comparison/comparison.h"
#include "base/text/json.h"

namespace swarmsmith {

/// A matrix of methods by missions, one for each source: which method wins, by how much, and how
/// certain that is. Made from a comparison by method.
struct MethodMatrix {
  struct Cell {
    std::size_t n = 0;     ///< number of values: designs or runs
    std::size_t runs = 0;  ///< number of runs in the values
    double mean = 0;
    std::optional<double> half_width;  ///< of Student's 95 % interval; empty for a single value
    double rank = 0;  ///< rank of the mean within the mission, 1 is best; ties share their rank
    /// Methods of a mission that share a letter do not differ at 5 % in the rank-sum tests of all
    /// its pairs with Holm's correction. Empty if there is only one method.
    std::string letters;
    double behind = 0;  ///< best mean of the mission minus this mean
    std::optional<double>
        p_behind;  ///< corrected p of the test against the method with the best mean
  };
  struct Row {
    std::string method;
    std::optional<double> mean_rank;  ///< over the missions; empty if a mission is missing
    std::vector<std::optional<Cell>> cells;
  };

  std::string source;
  std::vector<std::string> missions;
  std::vector<Row> rows;  ///< best mean rank first, then by name
};

std::vector<MethodMatrix> method_matrices(const Comparison& comparison);

/// Caveats about the letters: the comparison's notes except those about ranks, and notes where
/// there are too few values for any difference.
std::vector<std::string> matrix_notes(const Comparison& comparison);

/// Assigns letters to `count` items: two items have no letter in common exactly if they differ
/// (`different[i][j]`). Letters are assigned in the order of the items. Source: Piepho 2004,
/// Journal of Computational and Graphical Statistics 13(2), insert and absorb.
std::vector<std::string> letters_of(const std::vector<std::vector<bool>>& different);

/// For people: one table per source, and how to read it.
std::string matrices_text(const Comparison& comparison);
/// One row per cell, full precision: docs/statistics.md.
std::string matrices_csv(const Comparison& comparison);
JsonPiece matrices_json(const Comparison& comparison);

}  // namespace swarmsmith
