#pragma once

#include <vector>

#include "base/text/toml_text.h"
#include "coordinator/campaign/campaign.h"

namespace swarmsmith {

/// A campaign as the lines of its file, from which both the normalised text and the list of what
/// decides the answer are made: they cannot disagree.

std::vector<Section> sections_of(const Campaign& campaign);

}  // namespace swarmsmith
