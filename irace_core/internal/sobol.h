#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace swarmsmith::irace {

/// Points of a Sobol sequence, in an order given by a seed (irace facts, 5): the seed permutes the
/// index, so that every seed gives other points with the same even spread, and the coordinates are
/// still those of the sequence. The points are the same on every machine: the arithmetic uses whole
/// numbers and one exact conversion.
///
/// Sources: Joe and Kuo (2008), see sobol_numbers.h; B. Burley, Practical hash-based Owen
/// scrambling, Journal of Computer Graphics Techniques 9(4), 2020, with the hash of N. Vegdahl,
/// which the R package spacefillr uses, and through it irace.
class SobolSequence {
 public:
  static std::size_t most_dimensions();

  /// 1 to most_dimensions() dimensions.
  SobolSequence(std::size_t dimensions, std::uint32_t seed);

  std::size_t dimensions() const { return dimensions_; }
  /// The coordinates of one point, each in [0, 1) with 24 bits; one for every dimension.
  void point(std::uint32_t index, std::span<double> coordinates) const;

 private:
  std::size_t dimensions_;
  std::uint32_t hashed_seed_;
  std::vector<std::uint32_t> directions_;  ///< by bit of the index, then dimension
};

}  // namespace swarmsmith::irace
