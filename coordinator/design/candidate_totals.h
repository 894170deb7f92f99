#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "storage/rows.h"

namespace swarmsmith {

/// For each candidate of a design, the sums over the runs that its race used, in the race's order.
/// Candidates are numbered from 1 in the order of their creation; all numbers up to `count` exist.
class CandidateTotals {
 public:
  explicit CandidateTotals(DesignId design) : design_(design) {}

  /// Candidates up to this number have been created.
  void add_up_to(std::int64_t number);
  std::int64_t count() const { return static_cast<std::int64_t>(runs_.size()); }

  /// The race used a run with this score; returns the candidate's row.
  CandidateTotalsRow add_run(std::int64_t number, double score);
  /// A targetEvaluator gave this score for the candidate's run on this pair; it replaces an earlier
  /// score of this run. Returns the candidate's row over all such scores.
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
