#pragma once

namespace swarmsmith {

/// The value after a way through a float32. Not inline: where GCC 12 vectorises two of these
/// conversions, it drops them (the tests of RobotSenses have seen it).
double as_float32(double value);

}  // namespace swarmsmith
