#pragma once

#include <string>
#include <vector>

#include "base/expected.h"
#include "tracking/app/score_arguments.h"
#include "tracking/rig/run_log.h"

namespace swarmsmith {

/// E_CONFIG of an option of the command line.
Error wrong_option(const std::string& text, const std::string& option);

/// What the words of the command line change about the log; returns everything that is wrong with
/// them, and without a time at which the run begins.
std::vector<Error> take_options(const ScoreArguments& arguments, RunLog& log);

}  // namespace swarmsmith
