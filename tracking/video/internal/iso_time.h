#pragma once

#include <optional>
#include <string_view>

namespace swarmsmith {

/// Seconds since 1970 of a date and time of day as ISO 8601 writes them, and as names of files do,
/// which may have no colons: "2026-11-18T11:06:40.25Z", "2026-11-18T11-06-40-250",
/// "2026-11-18 11:06:40+01:00". At least to the second; without a zone it is UTC.
std::optional<double> iso_time(std::string_view text);

/// The first one within a text.
std::optional<double> iso_time_in(std::string_view text);

}  // namespace swarmsmith
