#pragma once

#include <string_view>

namespace swarmsmith {

/// Whether a name comes before another as a person counts: "shot9.png" before "shot10.png". Runs
/// of digits compare by value, all else by its bytes; a strict order of all names.
bool comes_before(std::string_view a, std::string_view b);

}  // namespace swarmsmith
