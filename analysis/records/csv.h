#pragma once

#include <string>

#include "base/expected.h"
#include "storage/store.h"

namespace swarmsmith {

/// The rows of a statement over the store's views as CSV (base/text/csv.h): a header, full
/// precision, null empty. Errors: as in records.h.
Expected<std::string> csv_of_rows(StoreReader& store, const std::string& sql);

}  // namespace swarmsmith
