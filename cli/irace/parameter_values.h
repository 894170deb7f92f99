#pragma once

#include <map>
#include <string>
#include <string_view>
#include <variant>

#include "base/expected.h"

namespace swarmsmith::cli {

/// The active parameters of a candidate, by name.
using ParameterValues = std::map<std::string, std::variant<double, std::string>, std::less<>>;

/// Reads CandidateRow::parameters: a flat JSON object of numbers and texts. Corrupt if the text is
/// not such an object.
Expected<ParameterValues> parse_parameter_values(std::string_view json);

}  // namespace swarmsmith::cli
