#pragma once

#include <string>
#include <vector>

#include "base/expected.h"
#include "base/text/table_reader.h"

namespace swarmsmith {

/// What is wrong with a file of settings, as E_CONFIG; messages that begin with a code of their own
/// keep it.
std::vector<Error> config_errors(std::vector<Error> errors);

/// A text that must be there; empty after a complaint. `example` shows one.
std::string need_text(TableReader& table, std::string_view key, std::string_view example);

}  // namespace swarmsmith
