#pragma once

#include <string>
#include <vector>

#include "sim/control/flavour.h"

namespace swarmsmith {

/// The views of schema/views.sql. flavour_name has the modules of this program's flavours, and
/// those of `own`, the flavours of the store's campaigns that are not built in.
std::string our_views(const std::vector<const Flavour*>& own);

/// The statement that creates flavour_name.
std::string flavour_view(const std::vector<const Flavour*>& own);

}  // namespace swarmsmith
