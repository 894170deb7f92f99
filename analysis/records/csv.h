#pragma once

#include <string>
#include <string_view>

#include "base/expected.h"
#include "storage/store.h"

namespace swarmsmith {

/// A field as RFC 4180 has it: in quotes when it must be.
std::string csv_field(std::string_view text);

/// The rows of a statement over the store's views as CSV: a header, full precision, null empty.
/// Errors: as in records.h.
Expected<std::string> csv_of_rows(StoreReader& store, const std::string& sql);

}  // namespace swarmsmith
