#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "base/expected.h"

namespace swarmsmith {

/// "1-10", "7", "1-3,8,10-12": seeds within 1..2147483647, in the order given, each once.
Expected<std::vector<std::int64_t>> parse_seeds(std::string_view text);

}  // namespace swarmsmith
