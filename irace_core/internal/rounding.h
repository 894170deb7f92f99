#pragma once

namespace swarmsmith::irace {

/// R's integers end here: what is larger is a real, as irace has all values of parameters.
inline constexpr double kLargestInteger = 2147483647;
/// Values are doubles: beyond this not every whole number is one.
inline constexpr double kLargestWhole = 9007199254740991;

/// `value` with `digits` decimals (0 to 15), by R's rule since 4.0.0: of the two neighbouring
/// decimals the one that is nearer in double arithmetic; on a tie the one whose last digit is even.
/// Values of 15 and more significant digits before that decimal are returned as they are.
double round_to_digits(double value, int digits);

}  // namespace swarmsmith::irace
