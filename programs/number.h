#pragma once

#include <optional>
#include <string_view>

namespace swarmsmith {

/// Parses a number as R's as.numeric does: decimal with e or E, hexadecimal with p or P, Inf and
/// infinity in any case, with or without a sign. NaN and NA give NaN; other texts give nothing.
std::optional<double> parse_number(std::string_view text);

}  // namespace swarmsmith
