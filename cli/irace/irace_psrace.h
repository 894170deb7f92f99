#pragma once

#include <filesystem>

#include "cli/irace/irace_run.h"
#include "console/output.h"
#include "irace_core/files/settings.h"

namespace swarmsmith::cli {

/// R's psRace(): one more race of configurations that the run in `finished` found, from the
/// beginning and on new pairs, until one is left or its budget is used. Goes on as a run of its
/// own, in `store`.
ExitCode race_again(Output& output, const IraceSettings& settings, const IraceSetup& setup,
                    const std::filesystem::path& finished, const StorePlace& store,
                    const IraceSlots& slots);

}  // namespace swarmsmith::cli
