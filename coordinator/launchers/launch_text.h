#pragma once

#include <string_view>

#include "base/expected.h"
#include "coordinator/launchers/launch_options.h"

namespace swarmsmith {

/// Reads the value of `--workers`: auto, N, local:N, ssh:HOSTFILE, slurm or slurm:JOBSxCPUS. N
/// workers have a slot each, so that others on a shared host keep their cores; auto takes all
/// cores. What it does not say stays as in `defaults`, the campaign file's. Errors: BadInput
/// without a place.
Expected<LaunchOptions> parse_workers(std::string_view text, const LaunchOptions& defaults);

}  // namespace swarmsmith
