#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

namespace swarmsmith {

/// Two numbers processed together: + - * / and comparisons act on each, `a < b ? c : d` selects for
/// each. It is for loops that the compiler would otherwise process one number at a time, with
/// unpredictable branches. Each result has the same bits as if it were computed alone.
using Two [[gnu::vector_size(16)]] = double;

inline Two both(double x) {
  return Two{x, x};
}

/// Like std::min and std::max.
inline Two lesser(Two a, Two b) {
  return b < a ? b : a;
}
inline Two greater(Two a, Two b) {
  return a < b ? b : a;
}

/// The bits of two numbers, and the results of comparisons: all bits set where true, none where
/// false.
using TwoBits [[gnu::vector_size(16)]] = std::int64_t;
inline constexpr TwoBits kSigns = {INT64_MIN, INT64_MIN};

/// The absolute values.
inline Two size_of(Two x) {
  return std::bit_cast<Two>(std::bit_cast<TwoBits>(x) & ~kSigns);
}
/// Non-negative numbers, with the signs of other numbers.
inline Two with_sign(Two size, Two signs) {
  return std::bit_cast<Two>(std::bit_cast<TwoBits>(size) |
                            (std::bit_cast<TwoBits>(signs) & kSigns));
}
/// The numbers, with the sign changed where `holds` is true.
inline Two turned_where(TwoBits holds, Two x) {
  return std::bit_cast<Two>(std::bit_cast<TwoBits>(x) ^ (holds & kSigns));
}
/// The numbers where `holds` is true, 0 elsewhere.
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
