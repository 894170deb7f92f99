#pragma once

#include <string>
#include <vector>

#include "sim/control/flavour.h"

namespace swarmsmith {

/// The views of schema/views.sql, with the modules in flavour_name that this program knows, and
/// those of `own`, flavours of the store's campaigns that are not built in.
std::string our_views(const std::vector<const Flavour*>& own);

/// The statement of them that makes flavour_name.
std::string flavour_view(const std::vector<const Flavour*>& own);

}  // namespace swarmsmith
