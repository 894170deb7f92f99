#pragma once

#include <vector>

#include "base/text/toml_text.h"
#include "coordinator/campaign/campaign.h"

namespace swarmsmith {

/// A campaign as the lines of its file. Both the normalised text and the list of values that decide
/// the answer are made from these lines, so they always agree.

std::vector<Section> sections_of(const Campaign& campaign);

}  // namespace swarmsmith
