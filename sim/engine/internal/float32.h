#pragma once

namespace swarmsmith {

/// The value rounded to float32. Not inline: where GCC 12 vectorises two of these conversions, it
/// drops them (as the tests of RobotSenses have shown).
double as_float32(double value);

}  // namespace swarmsmith
