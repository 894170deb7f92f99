#pragma once

#include <cstring>

namespace swarmsmith {

/// Two numbers that are worked on at once: + - * / and comparisons act on each, `a < b ? c : d`
/// selects in each. For loops that the compiler, left to itself, takes one by one and with branches
/// of which nobody knows where they go. Each has the bits that it would have alone.
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

/// Without the sign, but for that of zeros.
inline Two size_of(Two x) {
  return x < 0 ? -x : x;
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
