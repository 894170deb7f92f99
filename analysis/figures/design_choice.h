#pragma once

#include <string_view>

#include "analysis/figures/figure.h"

namespace swarmsmith {

/// The only design that passes the filter, for the kind `name`. Errors: BadInput if several pass;
/// NotFound if none passes.
Expected<DesignRecord> chosen_design(StoreReader& store, const FigureOptions& options,
                                     std::string_view name);

/// "aggregation, watermelon"
std::string title_of(const DesignRecord& design);

}  // namespace swarmsmith
