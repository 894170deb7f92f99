#pragma once

#include "base/expected.h"
#include "coordinator/campaign/campaign.h"
#include "irace_core/files/irace_setup.h"

namespace swarmsmith {

/// The campaign of one design that an irace scenario asks for: mission `tuning`, method `irace`,
/// the target evaluates. The seed is the setup's, or `seed` when it has none.
Campaign campaign_of(const IraceSetup& setup, std::uint64_t seed);

}  // namespace swarmsmith
