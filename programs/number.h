#pragma once

#include <optional>
#include <string_view>

namespace swarmsmith {

/// Number as R's as.numeric reads it: decimal with e or E, hexadecimal with p or P, Inf and
/// infinity in any case, with a sign or without. NaN and NA give NaN; other texts nothing.
std::optional<double> parse_number(std::string_view text);

}  // namespace swarmsmith
