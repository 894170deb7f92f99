#pragma once

#include "base/expected.h"
#include "coordinator/campaign/campaign.h"
#include "irace_core/files/irace_setup.h"

namespace swarmsmith {

/// The campaign with one design that corresponds to an irace scenario: mission `tuning`, method
/// `irace`, evaluated by the target. `seed` is used if the setup has no seed.
Campaign campaign_of(const IraceSetup& setup, std::uint64_t seed);

}  // namespace swarmsmith
