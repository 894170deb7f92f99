#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "analysis/machines/machine_layout.h"

namespace swarmsmith {

/// A text in quotes, as Graphviz reads it back.
std::string dot_text(std::string_view text);

/// Lines of a label in quotes, joined by DOT's own sign for a centred line.
std::string dot_label(const std::vector<LabelLine>& lines);

}  // namespace swarmsmith
