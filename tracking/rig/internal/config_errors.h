#pragma once

#include <string>
#include <vector>

#include "base/expected.h"
#include "base/text/table_reader.h"

namespace swarmsmith {

/// Turns the errors of a settings file into E_CONFIG; an error whose message begins with another
/// code keeps it.
std::vector<Error> config_errors(std::vector<Error> errors);

/// Reads a required text. If it is missing, adds an error that shows `example`, and returns "".
std::string need_text(TableReader& table, std::string_view key, std::string_view example);

}  // namespace swarmsmith
