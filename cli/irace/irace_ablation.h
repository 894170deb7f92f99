#pragma once

#include <filesystem>

#include "console/output.h"
#include "coordinator/campaign/campaign.h"
#include "irace_core/files/irace_setup.h"
#include "irace_core/files/settings.h"

namespace swarmsmith::cli {

/// R's ablation(): the way from a configuration of the run in `finished` to its best one, parameter
/// by parameter, each time the change that costs least on training instances.
/// Prints steps and the best configuration on the way; where asked to, keeps all runs in a CSV
/// file.
ExitCode ablate(Output& output, const IraceSettings& settings, const IraceSetup& setup,
                const Campaign& campaign, const std::filesystem::path& finished);

}  // namespace swarmsmith::cli
