#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "base/id.h"
#include "base/rng.h"

namespace swarmsmith {

/// How much of what a race saw goes with a parameter.

struct ScoredPair {
  CandidateId candidate;
  std::int64_t pair = 0;
  double score = 0;
};

/// How much better each candidate is than the others on the same pairs: its part of the model score
/// = candidate + pair, fitted by least squares. A plain mean would be that of the pairs that it
/// lived to see.
std::map<CandidateId, double> candidate_effects(const std::vector<ScoredPair>& scores);

/// Part of the variance of the values that lies between their groups, 0 to 1; 0 for equal values
/// (Fisher 1925: the correlation ratio, squared). Both lists have one length, not 0.
double eta_squared(const std::vector<std::size_t>& groups, const std::vector<double>& values);

struct Importance {
  double eta_squared = 0;
  double by_chance = 0;  ///< not exceeded by 95 % of 200 shuffles of the values
};

Importance importance_of(const std::vector<std::size_t>& groups, std::vector<double> values,
                         Rng rng);

}  // namespace swarmsmith
