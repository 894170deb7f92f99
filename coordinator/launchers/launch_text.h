#pragma once

#include <string_view>

#include "base/expected.h"
#include "coordinator/launchers/launch_options.h"

namespace swarmsmith {

/// Parses the value of `--workers`: auto, N, local:N, ssh:HOSTFILE, slurm or slurm:JOBSxCPUS. N
/// workers have one slot each, so that other users of a shared host keep their cores; auto takes
/// all cores. Settings that the value does not give keep their values from `defaults`, the campaign
/// file's settings. Errors: BadInput without a place.
Expected<LaunchOptions> parse_workers(std::string_view text, const LaunchOptions& defaults);

}  // namespace swarmsmith
