#pragma once

#include <string>

#include "sim/control/flavour.h"
#include "storage/store.h"

namespace swarmsmith {

/// The flavour of a design according to the store: built in, or from its campaign; null if this
/// version does not know the name.
const Flavour* flavour_of_design(StoreReader& store, DesignId design, const std::string& name);

}  // namespace swarmsmith
