#include "coordinator/design/candidate_totals.h"

#include <algorithm>
#include <limits>

#include "base/assert.h"

namespace swarmsmith {

void CandidateTotals::Sums::add(double score) {
  runs += 1;
  score_sum += score;
  // Only finite numbers can be stored, and no result depends on the squares.
  score_squares = std::min(score_squares + score * score, std::numeric_limits<double>::max());
}

void CandidateTotals::add_up_to(std::int64_t number) {
  SWARMSMITH_ASSERT(number > count(), "configurations are numbered in the order of their creation");
  runs_.resize(static_cast<std::size_t>(number));
}

CandidateTotalsRow CandidateTotals::add_run(std::int64_t number, double score) {
  SWARMSMITH_ASSERT(number >= 1 && number <= count(), "a run needs an existing candidate");
  Sums& sums = runs_[static_cast<std::size_t>(number - 1)];
  sums.add(score);
  return row(number, sums);
}

CandidateTotalsRow CandidateTotals::judge(std::int64_t number, std::int64_t pair, double score) {
  SWARMSMITH_ASSERT(number >= 1 && number <= count(), "a call needs an existing candidate");
  if (judged_.size() < runs_.size()) judged_.resize(runs_.size());
  auto& by_pair = judged_[static_cast<std::size_t>(number - 1)];
  by_pair[pair] = score;
  // Summed again in the order of the pairs, because subtracting an old score would round.
  Sums sums;
  for (const auto& [of, judged] : by_pair)
    sums.add(judged);
  return row(number, sums);
}

CandidateTotalsRow CandidateTotals::row(std::int64_t number, const Sums& sums) const {
  return {.candidate = candidate_id(design_, number),
          .runs = sums.runs,
          .score_sum = sums.score_sum,
          .score_squares = sums.score_squares};
}

}  // namespace swarmsmith
