#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"

namespace swarmsmith {

/// The name of a robot from an argument: `2` is rvr2, any other plain name is used unchanged.
Expected<std::string> robot_name(const std::string& word);
/// The largest index of a robot's random stream.
inline constexpr int kMostIndex = 100'000;
/// Index of a robot's random stream, from its name: 0 for rvr1; none for a name without a number,
/// or with one that is too large.
std::optional<int> index_in_name(const std::string& name);
/// The names of several robots: `1-3` is rvr1, rvr2, rvr3; the names in `rvr1,rvr4` are used
/// unchanged.
Expected<std::vector<std::string>> robot_names(const std::string& words);

}  // namespace swarmsmith
