#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text/table_reader.h"
#include "sim/control/reference_model.h"

namespace swarmsmith {

/// Reads a colour by name or number; the key is required.
std::optional<Rgb> read_color(TableReader& table, std::string_view key);

/// The keys of a table whose keys are colours, sorted by the colours' canonical names, so that
/// their spelling has no effect. Two spellings of one colour are a complaint.
std::vector<std::pair<std::string, Rgb>> read_color_keys(TableReader& table);

}  // namespace swarmsmith
