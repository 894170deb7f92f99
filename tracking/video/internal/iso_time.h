#pragma once

#include <optional>
#include <string_view>

namespace swarmsmith {

/// Converts a date with a time of day to seconds since 1970. The form is ISO 8601, or as in file
/// names, which may have no colons: "2026-11-18T11:06:40.25Z", "2026-11-18T11-06-40-250",
/// "2026-11-18 11:06:40+01:00". Needs at least seconds; without a zone the time is UTC.
std::optional<double> iso_time(std::string_view text);

/// The first date in a text.
std::optional<double> iso_time_in(std::string_view text);

}  // namespace swarmsmith
