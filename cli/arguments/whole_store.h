#pragma once

#include "cli/arguments/store_argument.h"

namespace swarmsmith::cli {

/// Opens the store that is named, for numbers that leave it: refuses one whose rows are not those
/// of one commit (storage/whole.h).
Expected<std::unique_ptr<StoreReader>> open_whole(const StoreArgument& argument);

}  // namespace swarmsmith::cli
