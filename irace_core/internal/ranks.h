#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace swarmsmith::irace {

/// One configuration's cost on one pair.
struct Entry {
  double cost;
  std::uint32_t column;
};

/// Average ranks of costs within rows, summed over the rows, for a shrinking set of columns.
///
/// Rows are kept sorted, so that a row is sorted only once and takes a linear pass whenever columns
/// are dropped. All sums are multiples of 1/4 far below 2^53, so that they are exact for any order
/// of summation.
class RankTable {
 public:
  /// The columns are 0 .. columns-1, and all take part.
  explicit RankTable(std::size_t columns);

  /// Adds a row with one finite cost for every column that takes part.
  void add_row(std::vector<Entry> row);
  /// Removes the columns for which `keeps` is false.
  void keep(const std::vector<bool>& keeps);

  std::int64_t rows() const { return static_cast<std::int64_t>(rows_.size()); }
  std::int64_t columns() const { return columns_; }
  /// R_j: sum over rows of the rank of column j.
  double rank_sum(std::size_t column) const { return sums_[column]; }
  /// Sum of u^3 - u over the sizes u of all groups of equal costs.
  double ties() const { return ties_; }
  /// Sum of all squared ranks.
  double squares() const { return squares_; }

 private:
  void add_ranks(std::span<const Entry> sorted);

  std::vector<std::vector<Entry>> rows_;  ///< sorted by cost, then column
  std::int64_t columns_;
  std::vector<double> sums_;
  double ties_ = 0;
  double squares_ = 0;
};

}  // namespace swarmsmith::irace
