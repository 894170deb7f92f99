#pragma once

namespace swarmsmith::irace {

/// The largest integer of R; larger values are reals, as all parameter values are in irace.
inline constexpr double kLargestInteger = 2147483647;
/// Values are doubles; above this limit, doubles do not represent every whole number.
inline constexpr double kLargestWhole = 9007199254740991;

/// With more digits below 0, every double is rounded to 0.
inline constexpr double kMostZeros = 309;

/// `value` with `digits` decimals (-309 to 15; -2: hundreds), by R's rule since 4.0.0: of the two
/// neighbouring decimals the one that is nearer in double arithmetic; on a tie the one whose last
/// digit is even.
/// A value that would keep more than 15 significant digits is returned unchanged.
double round_to_digits(double value, int digits);

}  // namespace swarmsmith::irace
