#pragma once

#include <string>
#include <vector>

#include "console/declared.h"
#include "console/output.h"

namespace swarmsmith::cli {

/// `swarmsmith irace`: takes the options of irace and those in docs/command-line.md.
ExitCode run_irace(const std::vector<std::string>& given, Output& output);
/// The options of `swarmsmith irace`.
std::vector<DeclaredOption> irace_declared();

}  // namespace swarmsmith::cli
