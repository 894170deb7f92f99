#pragma once

#include <string_view>

namespace swarmsmith {

/// Whether a name comes before another in natural order: "shot9.png" before "shot10.png". Digits
/// are compared by their value, everything else by its bytes; a strict total order.
bool comes_before(std::string_view a, std::string_view b);

}  // namespace swarmsmith
