#pragma once

#include <filesystem>

#include "cli/irace/irace_run.h"
#include "console/output.h"
#include "irace_core/files/irace_setup.h"

namespace swarmsmith::cli {

/// irace's --only-test: evaluates the configurations of a file on the test instances and prints
/// their costs. The evaluations are kept like those of a run, and continue like those.
ExitCode only_test(Output& output, const IraceSetup& setup, const std::filesystem::path& file,
                   const StorePlace& store, const IraceSlots& slots);

}  // namespace swarmsmith::cli
