#pragma once

#include <memory>
#include <string>

#include "coordinator/campaign/method_space.h"
#include "irace_core/iterated_race.h"

namespace swarmsmith {

/// Repairs configurations by a program (irace's repairConfiguration, which is an R function there).
/// The program gets a configurations file (irace facts, 23.4) of two lines on its standard input,
/// names and values, and prints one of the same form. It runs in `folder` and must be a pure
/// function: a race that is played again asks it again. A program that fails, prints anything else
/// or a configuration that is not in the space is an error.
Repair repair_by(const std::string& program, const std::string& folder,
                 std::shared_ptr<const MethodSpace> space);

}  // namespace swarmsmith
