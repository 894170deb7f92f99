#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "base/id.h"
#include "base/rng.h"

namespace swarmsmith {

/// How strongly a parameter is related to the scores in a race.

struct ScoredPair {
  CandidateId candidate;
  std::int64_t pair = 0;
  double score = 0;
};

/// How much better each candidate is than the others on the same pairs: its term in the model score
/// = candidate + pair, fitted by least squares. A plain mean would depend on the pairs on which the
/// candidate was still alive.
std::map<CandidateId, double> candidate_effects(const std::vector<ScoredPair>& scores);

/// The part of the values' variance that lies between their groups, 0 to 1; 0 for equal values
/// (Fisher 1925: the squared correlation ratio). The lists have the same length and are not empty.
double eta_squared(const std::vector<std::size_t>& groups, const std::vector<double>& values);

struct Importance {
  double eta_squared = 0;
  double by_chance = 0;  ///< exceeded by only 5 % of 200 shuffles of the values
};

Importance importance_of(const std::vector<std::size_t>& groups, std::vector<double> values,
                         Rng rng);

}  // namespace swarmsmith
