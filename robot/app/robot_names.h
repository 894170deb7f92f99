#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"

namespace swarmsmith {

/// A robot by a word: `2` is rvr2, any other plain name is itself.
Expected<std::string> robot_name(const std::string& word);
/// Index of a robot's random stream by its name: rvr1 has 0; none for a name without a number.
std::optional<int> index_in_name(const std::string& name);
/// `1-3` is rvr1, rvr2, rvr3; `rvr1,rvr4` is as it stands.
Expected<std::vector<std::string>> robot_names(const std::string& words);

}  // namespace swarmsmith
