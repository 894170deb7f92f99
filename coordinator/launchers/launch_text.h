#pragma once

#include <string_view>

#include "base/expected.h"
#include "coordinator/launchers/launch_options.h"

namespace swarmsmith {

/// Reads the value of `--workers`: auto, N, local:N, ssh:HOSTFILE, slurm or slurm:JOBSxCPUS. What
/// it does not say stays as in `defaults`, the campaign file's. Errors: BadInput without a place.
Expected<LaunchOptions> parse_workers(std::string_view text, const LaunchOptions& defaults);

}  // namespace swarmsmith
