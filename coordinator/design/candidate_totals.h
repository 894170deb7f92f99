#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "storage/rows.h"

namespace swarmsmith {

/// The sums over the runs of each candidate of a design that its race used, in the race's order.
/// Candidates have the numbers from 1 in the order of their creation; all are known whose number is
/// at most `count`.
class CandidateTotals {
 public:
  explicit CandidateTotals(DesignId design) : design_(design) {}

  /// Those up to this number have been made.
  void add_up_to(std::int64_t number);
  std::int64_t count() const { return static_cast<std::int64_t>(runs_.size()); }

  /// The race used a run with this score; the candidate's row.
  CandidateTotalsRow add_run(std::int64_t number, double score);
  /// What a targetEvaluator said last of its run on this pair, in place of what it said before; the
  /// candidate's row, over all such words.
  CandidateTotalsRow judge(std::int64_t number, std::int64_t pair, double score);

 private:
  struct Sums {
    void add(double score);

    std::int64_t runs = 0;
    double score_sum = 0;
    double score_squares = 0;
  };

  CandidateTotalsRow row(std::int64_t number, const Sums& sums) const;

  DesignId design_;
  std::vector<Sums> runs_;                              ///< by number - 1
  std::vector<std::map<std::int64_t, double>> judged_;  ///< by number - 1, score by pair
};

}  // namespace swarmsmith
