#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text/table_reader.h"
#include "sim/control/reference_model.h"

namespace swarmsmith {

/// A colour by name or number; the key must be there.
std::optional<Rgb> read_color(TableReader& table, std::string_view key);

/// The keys of a table whose keys are colours, in the order of the colours' own names, so that the
/// spelling decides nothing. Two spellings of one colour are a complaint.
std::vector<std::pair<std::string, Rgb>> read_color_keys(TableReader& table);

}  // namespace swarmsmith
