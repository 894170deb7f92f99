#pragma once

namespace swarmsmith::irace {

/// `value` with `digits` decimals (0 to 15), by R's rule since 4.0.0: of the two neighbouring
/// decimals the one that is nearer in double arithmetic; on a tie the one whose last digit is even.
/// Values of 15 and more significant digits before that decimal are returned as they are.
double round_to_digits(double value, int digits);

}  // namespace swarmsmith::irace
