#pragma once

#include <string_view>

#include "analysis/figures/figure.h"

namespace swarmsmith {

/// The one design that the filter leaves, for the kind `name`. Errors: BadInput when it leaves
/// several; NotFound without one.
Expected<DesignRecord> chosen_design(StoreReader& store, const FigureOptions& options,
                                     std::string_view name);

/// "aggregation, watermelon"
std::string title_of(const DesignRecord& design);

}  // namespace swarmsmith
