#pragma once

#include "console/output.h"
#include "coordinator/campaign/campaign.h"
#include "irace_core/files/irace_setup.h"

namespace swarmsmith::cli {

/// irace's --check: calls the target for the given configurations and two random ones, on one
/// instance with one seed, in this process, and prints each call and what came of it. `campaign` is
/// the setup's. Failed, when a call fails or the race could not even begin.
ExitCode check_target(Output& output, const IraceSetup& setup, const Campaign& campaign);

}  // namespace swarmsmith::cli
