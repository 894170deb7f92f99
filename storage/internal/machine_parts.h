#pragma once

#include <string>
#include <string_view>

#include "storage/internal/sqlite.h"

namespace swarmsmith {

/// What views.sql computes from the text of a machine or a tree, "--nstates 2 --s0 1 --n0 1 --n0x0
/// 0".

/// The states that can be reached from the first one, ascending, separated by blanks: " 0 1 ".
std::string reached_states(std::string_view text);

/// How often each module is in the text, and how often in reachable states, as a JSON object:
/// {"s1":"2 1"}. Keys are a kind (s behaviour, c condition) and the module's number.
std::string module_counts(std::string_view text);

/// Adds both functions to the connection as SQL functions, for schema/lent_views.sql.
void add_machine_functions(const sqlite::Connection& connection);

}  // namespace swarmsmith
