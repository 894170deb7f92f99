#pragma once

#include <string>
#include <string_view>

namespace swarmsmith {

/// A text as a field of RFC 4180: in quotes where it needs them.
std::string csv_text(std::string_view text);

}  // namespace swarmsmith
