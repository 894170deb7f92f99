#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace swarmsmith::irace {

inline constexpr std::size_t kSobolDimensions = 1111;
inline constexpr std::size_t kSobolNumbers = 14333;

/// The numbers that define Sobol sequences in up to 1111 dimensions: for each dimension from the
/// second on a primitive polynomial over {0, 1}, with its coefficients as bits, and then as many
/// initial numbers m_1, m_2, ... as its degree (at most 13).
///
/// Source: S. Joe and F. Y. Kuo, Constructing Sobol sequences with better two-dimensional
/// projections, SIAM J. Sci. Comput. 30, 2635-2654 (2008), the file new-joe-kuo-6.21201, cut at
/// degree 13. irace has 1024 dimensions of the same numbers.
extern const std::array<std::uint16_t, kSobolNumbers> sobol_numbers;

}  // namespace swarmsmith::irace
