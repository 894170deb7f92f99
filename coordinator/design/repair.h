#pragma once

#include <memory>
#include <string>

#include "coordinator/campaign/method_space.h"
#include "irace_core/iterated_race.h"

namespace swarmsmith {

/// Repairs configurations with a program (irace's repairConfiguration, which in irace is an R
/// function). The program reads a configurations file (irace facts, 23.4) of two lines, names and
/// values, from its standard input, and prints one in the same format. It runs in `folder` and must
/// be a pure function, because a replay of the race calls it again. Errors: the program fails, or
/// prints other text or a configuration that is not in the space.
Repair repair_by(const std::string& program, const std::string& folder,
                 std::shared_ptr<const MethodSpace> space);

}  // namespace swarmsmith
