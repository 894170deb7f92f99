#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

namespace swarmsmith {

/// Two numbers that are worked on at once: + - * / and comparisons act on each, `a < b ? c : d`
/// selects in each. For loops that the compiler, left to itself, takes one by one and with branches
/// that cannot be predicted. Each has the bits that it would have alone.
using Two [[gnu::vector_size(16)]] = double;

inline Two both(double x) {
  return Two{x, x};
}

/// As std::min and std::max are.
inline Two lesser(Two a, Two b) {
  return b < a ? b : a;
}
inline Two greater(Two a, Two b) {
  return a < b ? b : a;
}

/// Their bits, and what comparisons give: of each all bits where it holds, none elsewhere.
using TwoBits [[gnu::vector_size(16)]] = std::int64_t;
inline constexpr TwoBits kSigns = {INT64_MIN, INT64_MIN};

/// Without the sign.
inline Two size_of(Two x) {
  return std::bit_cast<Two>(std::bit_cast<TwoBits>(x) & ~kSigns);
}
/// Numbers that are not negative, with the signs of others.
inline Two with_sign(Two size, Two signs) {
  return std::bit_cast<Two>(std::bit_cast<TwoBits>(size) |
                            (std::bit_cast<TwoBits>(signs) & kSigns));
}
/// The other sign where it holds.
inline Two turned_where(TwoBits holds, Two x) {
  return std::bit_cast<Two>(std::bit_cast<TwoBits>(x) ^ (holds & kSigns));
}
/// Numbers where it holds, 0 elsewhere.
inline Two only_where(TwoBits holds, Two x) {
  return std::bit_cast<Two>(std::bit_cast<TwoBits>(x) & holds);
}

inline Two load_two(const double* from) {
  Two values;
  std::memcpy(&values, from, sizeof values);
  return values;
}

inline void store_two(Two values, double* to) {
  std::memcpy(to, &values, sizeof values);
}

}  // namespace swarmsmith
