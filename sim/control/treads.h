#pragma once

namespace swarmsmith {

/// Distance between the treads (rvr-automode facts, section 2). It turns a difference of tread
/// speeds into a turn rate. It has its own file because the ROS side of robots is C++17.
inline constexpr double kTreadDistance_m = 0.147;

}  // namespace swarmsmith
