#pragma once

#include <string>
#include <vector>

#include "base/text/toml_text.h"
#include "sim/control/flavour.h"

namespace swarmsmith {

/// The whole flavour as lines; `header` is the name of the table that holds them, such as
/// "method.flavour".
std::vector<Section> flavour_sections(const Flavour& flavour, const std::string& header);

/// The whole flavour as the text of a file that parse_flavour reads back.
std::string flavour_text(const Flavour& flavour);

}  // namespace swarmsmith
