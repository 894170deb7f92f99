#pragma once

#include <cstdint>
#include <vector>

#include "base/rng.h"

namespace swarmsmith::irace {

/// The growing list of (instance, seed) pairs on which configurations are tried; a pair's number is
/// its row, from 1. Every configuration sees the same seed on a pair.
class InstanceLog {
 public:
  struct Pair {
    std::int64_t instance;  ///< 1..instances
    std::int64_t seed;      ///< 1..2147483647
  };

  InstanceLog(std::int64_t instances, bool shuffle, Rng rng)
      : instances_(instances), shuffle_(shuffle), rng_(rng) {}

  /// Appends whole repetitions of the list of instances, at least `pairs` pairs; each repetition
  /// in an order of its own when shuffling.
  void append(std::int64_t pairs);

  std::int64_t size() const { return static_cast<std::int64_t>(pairs_.size()); }
  const Pair& operator[](std::int64_t pair) const {
    return pairs_[static_cast<std::size_t>(pair - 1)];
  }
  const Rng& rng() const { return rng_; }

 private:
  std::int64_t instances_;
  bool shuffle_;
  Rng rng_;
  std::vector<Pair> pairs_;
};

}  // namespace swarmsmith::irace
