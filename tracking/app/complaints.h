#pragma once

#include <vector>

#include "console/output.h"

namespace swarmsmith::cli {

/// What to exit with when all this is wrong: 2 when a file of settings is, else 1.
ExitCode exit_code_of_all(const std::vector<Error>& errors);

/// Prints them all and says what to exit with.
ExitCode fail_all(Output& output, const std::vector<Error>& errors);

}  // namespace swarmsmith::cli
