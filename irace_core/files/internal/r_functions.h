#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "irace_core/files/internal/r_texts.h"

namespace swarmsmith::r {

/// Whether a name is one of these functions of R, which scenarios use in addition to the functions
/// of conditions, paste and Sys.getenv: getwd, normalizePath, dirname, basename, readLines,
/// sprintf, sub, gsub, seq, seq_len.
bool is_scenario_function(std::string_view name);
/// Their names, for a message.
std::string_view scenario_function_names();
/// Calls one of these functions.
Expected<Vector> call_scenario_function(const Node& node, const std::string& name,
                                        std::vector<Part> parts, const Environment& environment);

}  // namespace swarmsmith::r
