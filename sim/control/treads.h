#pragma once

namespace swarmsmith {

/// From tread to tread (rvr-automode facts, section 2): speeds of the treads become a turn by it.
/// Apart from the reference model, since ROS's side of robots is C++17.
inline constexpr double kTreadDistance_m = 0.147;

}  // namespace swarmsmith
