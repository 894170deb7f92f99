#include "irace_core/internal/sobol.h"

#include <algorithm>
#include <bit>

#include "base/assert.h"
#include "irace_core/internal/sobol_numbers.h"

namespace swarmsmith::irace {
namespace {

constexpr std::size_t kBits = 32;

std::uint32_t reverse_bits(std::uint32_t x) {
  std::uint32_t reversed = 0;
  for (std::size_t i = 0; i < kBits; ++i) {
    reversed = (reversed << 1U) | (x & 1U);
    x >>= 1U;
  }
  return reversed;
}

/// The rounds and multipliers of skeeto's hash-prospector, after mixing in the constant of the
/// scrambler; neighbouring seeds give unrelated permutations.
std::uint32_t hash_seed(std::uint32_t seed) {
  std::uint32_t x = 0x6217c6e1U ^ (seed + 0xa14a177dU * 0x9e3779b9U);
  x = (x ^ (x >> 17U)) * 0xed5ad4bbU;
  x = (x ^ (x >> 11U)) * 0xac4c1b51U;
  x = (x ^ (x >> 15U)) * 0x31848babU;
  return x ^ (x >> 14U);
}

/// A permutation in which each bit depends only on the lower ones (as proposed by Laine and
/// Karras); on reversed bits it is a nested scrambling in the sense of Owen.
std::uint32_t permute(std::uint32_t x, std::uint32_t hashed_seed) {
  x ^= x * 0x3d20adeaU;
  x += hashed_seed;
  x *= (hashed_seed >> 16U) | 1U;
  x ^= x * 0x05526c56U;
  x ^= x * 0x53a22864U;
  return x;
}

/// Direction numbers v_1 .. v_32 of one dimension as binary fractions, from the degree s of its
/// polynomial and m_1 .. m_s: v_k = a_1 v_(k-1) ^ ... ^ v_(k-s) ^ (v_(k-s) >> s).
void fill_directions(std::uint32_t polynomial, std::span<const std::uint16_t> initial,
                     std::size_t dimension, std::size_t dimensions,
                     std::vector<std::uint32_t>& directions) {
  const std::size_t degree = initial.size();
  const auto v = [&](std::size_t k) -> std::uint32_t& {
    return directions[k * dimensions + dimension];
  };
  for (std::size_t k = 0; k < kBits; ++k) {
    if (k < degree) {
      v(k) = std::uint32_t{initial[k]} << (kBits - 1 - k);
      continue;
    }
    v(k) = v(k - degree) ^ (v(k - degree) >> degree);
    for (std::size_t i = 1; i < degree; ++i) {
      if ((polynomial >> (degree - i) & 1U) != 0) v(k) ^= v(k - i);
    }
  }
}

}  // namespace

std::size_t SobolSequence::most_dimensions() {
  return kSobolDimensions;
}

SobolSequence::SobolSequence(std::size_t dimensions, std::uint32_t seed)
    : dimensions_(dimensions), hashed_seed_(hash_seed(seed)), directions_(kBits * dimensions) {
  SWARMSMITH_ASSERT(dimensions >= 1 && dimensions <= kSobolDimensions, "the table's dimensions");
  for (std::size_t k = 0; k < kBits; ++k)
    directions_[k * dimensions] = std::uint32_t{1} << (kBits - 1 - k);  // van der Corput
  std::span<const std::uint16_t> left(sobol_numbers);
  for (std::size_t dimension = 1; dimension < dimensions; ++dimension) {
    const std::uint32_t polynomial = left.front();
    const auto degree = static_cast<std::size_t>(std::bit_width(polynomial)) - 1;
    fill_directions(polynomial, left.subspan(1, degree), dimension, dimensions, directions_);
    left = left.subspan(1 + degree);
  }
}

void SobolSequence::point(std::uint32_t index, std::span<double> coordinates) const {
  SWARMSMITH_ASSERT(coordinates.size() == dimensions_, "one coordinate for every dimension");
  std::vector<std::uint32_t> bits(dimensions_, 0);
  std::uint32_t scrambled = reverse_bits(permute(reverse_bits(index), hashed_seed_));
  for (std::size_t k = 0; scrambled != 0; ++k, scrambled >>= 1U) {
    if ((scrambled & 1U) == 0) continue;
    const std::uint32_t* row = directions_.data() + k * dimensions_;
    for (std::size_t i = 0; i < dimensions_; ++i)
      bits[i] ^= row[i];
  }
  // Single precision as in irace; rounded to the nearest 24 bits, but never up to 1.
  constexpr float kBelowOne = 0x1.fffffep-1F;
  for (std::size_t i = 0; i < dimensions_; ++i) {
    coordinates[i] = std::min(static_cast<float>(bits[i]) * 0x1p-32F, kBelowOne);
  }
}

}  // namespace swarmsmith::irace
