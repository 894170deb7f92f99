#pragma once

#include <string>
#include <string_view>

#include "programs/output.h"

namespace swarmsmith {

/// Parses the line "Result of this algorithm run: {...}" of AClib's GenericWrapper4AC (irace facts,
/// 18.5).
Expected<Reading> parse_aclib(std::string_view output, const Target& target);

/// Checks a time that a program reports, and raises it to the smallest measurable time. `program`
/// is for the error message.
Expected<double> checked_time(double time, const std::string& program, const Target& target);

}  // namespace swarmsmith
