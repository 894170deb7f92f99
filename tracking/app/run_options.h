#pragma once

#include <string>
#include <vector>

#include "base/expected.h"
#include "tracking/app/score_arguments.h"
#include "tracking/rig/run_log.h"

namespace swarmsmith {

/// An E_CONFIG for an option of the command line.
Error wrong_option(const std::string& text, const std::string& option);

/// Applies `--start 12.4`, `--start "12.4 s"`, `--sync-hidden 99` to the log. Returns their errors.
std::vector<Error> take_start(const StartArguments& arguments, RunLog& log);

/// Applies the options of the command line to the log. Returns all their errors, and an error if
/// there is no time at which the run begins.
std::vector<Error> take_options(const ScoreArguments& arguments, RunLog& log);

}  // namespace swarmsmith
