#pragma once

#include <string>
#include <string_view>

#include "programs/output.h"

namespace swarmsmith {

/// The line "Result of this algorithm run: {...}" of AClib's GenericWrapper4AC (irace facts, 18.5).
Expected<Reading> parse_aclib(std::string_view output, const Target& target);

/// A time that a program reports, raised to what can be measured. `program` is for the sentence.
Expected<double> checked_time(double time, const std::string& program, const Target& target);

}  // namespace swarmsmith
