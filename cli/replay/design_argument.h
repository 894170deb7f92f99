#pragma once

#include <string>

#include "base/expected.h"
#include "cli/replay/machine_argument.h"
#include "console/output.h"
#include "coordinator/campaign/campaign.h"
#include "storage/rows.h"

namespace swarmsmith::cli {

/// The campaign of a campaign file or of a store. Prints all errors of a file except the last one,
/// which is returned.
Expected<Campaign> campaign_of(const std::string& file, Output& output);

/// Finds the design `d3` of a campaign. If `word` is empty: the first design, if all designs have
/// the same mission and the same method.
Expected<DesignRow> find_design(const Campaign& campaign, const std::string& word);

/// Gives a machine the simulation settings of a design: its mission, its method's flavour, the
/// campaign's profile.
void put_into_world(NamedMachine& machine, const Campaign& campaign, const DesignRow& design);

}  // namespace swarmsmith::cli
