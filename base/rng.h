#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <utility>

#include "base/hash.h"

namespace swarmsmith {

/// A named, counter-based stream of random numbers: the n-th number is a fixed function of the
/// stream's key and n, so the same seed gives the same numbers on every machine, compiler and
/// standard library. The distributions are implemented here for the same reason. Not thread-safe;
/// copy or split.
///
/// Generator: SplitMix64 (see base/hash.h), whose state is key + n * golden ratio.
class Rng {
 public:
  explicit Rng(std::uint64_t seed) : key_(mix64(seed + kGolden)) {}

  /// An independent stream, which depends on this stream's key, the name and the index, but not on
  /// how many numbers were drawn.
  [[nodiscard]] Rng split(std::string_view name, std::uint64_t index = 0) const;

  /// 64 uniform bits.
  std::uint64_t next() { return mix64(key_ + kGolden * ++drawn_); }

  /// Uniform in [0, 1), a multiple of 2^-53.
  double uniform() { return static_cast<double>(next() >> 11U) * 0x1.0p-53; }
  /// Uniform in [low, high); `low` when the interval is empty.
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Uniform in {0, ..., n-1}, without bias; n must be positive.
  std::uint64_t below(std::uint64_t n);
  /// Uniform in {low, ..., high}.
  std::int64_t uniform_int(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(below(static_cast<std::uint64_t>(high - low) + 1));
  }
  /// True with probability p (never for p <= 0, always for p >= 1).
  bool bernoulli(double p) { return uniform() < p; }
  /// Standard normal by inversion: each value takes one number of the stream.
  double normal();
  double normal(double mean, double sd) { return mean + sd * normal(); }

  template <class T>
  void shuffle(std::span<T> items) {
    for (std::size_t i = items.size(); i > 1; --i)
      std::swap(items[i - 1], items[below(i)]);
  }

  /// How many numbers were drawn. Together with the key, this is the whole state.
  std::uint64_t drawn() const { return drawn_; }
  std::uint64_t key() const { return key_; }

 private:
  static constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15U;

  std::uint64_t key_;
  std::uint64_t drawn_ = 0;
};

}  // namespace swarmsmith
