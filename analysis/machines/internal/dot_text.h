#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "analysis/machines/machine_layout.h"

namespace swarmsmith {

/// The text in quotes, escaped for Graphviz.
std::string dot_text(std::string_view text);

/// The lines of a label in quotes, joined by DOT's escape for a centred line.
std::string dot_label(const std::vector<LabelLine>& lines);

}  // namespace swarmsmith
