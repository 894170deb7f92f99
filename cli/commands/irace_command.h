#pragma once

#include <string>
#include <vector>

#include "console/declared.h"
#include "console/output.h"

namespace swarmsmith::cli {

/// `swarmsmith irace`: the words after it are irace's own and those of docs/command-line.md.
ExitCode run_irace(const std::vector<std::string>& given, Output& output);
/// Its options.
std::vector<DeclaredOption> irace_declared();

}  // namespace swarmsmith::cli
