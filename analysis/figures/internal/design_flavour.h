#pragma once

#include <string>

#include "sim/control/flavour.h"
#include "storage/store.h"

namespace swarmsmith {

/// The flavour that the store says of a design: built in, or one of its campaign's own; null where
/// this version has none of that name.
const Flavour* flavour_of_design(StoreReader& store, DesignId design, const std::string& name);

}  // namespace swarmsmith
