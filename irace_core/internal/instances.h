#pragma once

#include <cstdint>
#include <vector>

#include "base/assert.h"
#include "base/rng.h"
#include "irace_core/scenario.h"

namespace swarmsmith::irace {

/// The growing list of (instance, seed) pairs on which configurations are tried; the number of a
/// pair is its row, from 1. All configurations get the same seed on a pair (irace facts, 4).
class InstanceLog {
 public:
  struct Pair {
    std::int64_t instance;  ///< 1..instances
    std::int64_t seed;      ///< 1..2147483647
  };

  /// Reads the number, blocks and order of the instances from the scenario.
  InstanceLog(const Scenario& scenario, Rng rng);

  /// Appends complete repetitions of the list of instances, at least `pairs` pairs; with shuffling,
  /// each repetition has its blocks in a new order. With deterministic targets there is only the
  /// first repetition, for any `pairs`.
  void append(std::int64_t pairs);
  /// Appends until there are at least `pairs` pairs, if that is possible.
  void extend_to(std::int64_t pairs);

  std::int64_t size() const { return static_cast<std::int64_t>(pairs_.size()); }
  const Pair& operator[](std::int64_t pair) const {
    SWARMSMITH_ASSERT(pair >= 1 && pair <= size(), "a pair is a row of the list, from 1");
    return pairs_[static_cast<std::size_t>(pair - 1)];
  }
  const Rng& rng() const { return rng_; }

 private:
  std::int64_t instances_;
  std::int64_t block_size_;
  bool shuffle_;
  bool deterministic_;
  Rng rng_;
  std::vector<Pair> pairs_;
};

}  // namespace swarmsmith::irace
