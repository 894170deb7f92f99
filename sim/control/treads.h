#pragma once

namespace swarmsmith {

/// Distance between the treads (rvr-automode facts, section 2), by which tread speeds become a turn
/// rate. It has its own file because the ROS side of robots is C++17.
inline constexpr double kTreadDistance_m = 0.147;

}  // namespace swarmsmith
