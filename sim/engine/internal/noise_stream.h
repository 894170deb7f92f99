#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "base/rng.h"
#include "sim/control/reference_model.h"
#include "sim/engine/internal/normal_noise.h"

namespace swarmsmith {

/// How many numbers a cycle takes of a stream that has a number for each sensor of a ring. They are
/// always eight for up to eight sensors.
constexpr std::uint64_t numbers_per_cycle(std::size_t sensors) {
  return sensors <= kProximitySensors ? kProximitySensors : kMostRingSensors;
}

/// Counter-based noise of one kind, for one robot and run: the number at an index is a function of
/// seed, name, robot and index, independent of other draws.
class NoiseStream {
 public:
  /// A placeholder, which must not be drawn from.
  NoiseStream() = default;
  NoiseStream(const Rng& run, std::string_view name, int robot)
      : key_(run.split(name, static_cast<std::uint64_t>(robot)).key()) {}

  /// A stream with as many numbers as needed for one index.
  Rng at(std::uint64_t index) const { return Rng(key_ + index); }
  /// Standard normal.
  double normal(std::uint64_t index) const { return NormalNoise::instance().draw(at(index)); }

 private:
  std::uint64_t key_ = 0;
};

}  // namespace swarmsmith
