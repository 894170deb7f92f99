#pragma once

#include <string>
#include <string_view>

#include "analysis/machines/internal/sketch.h"
#include "analysis/machines/tree_layout.h"

namespace swarmsmith {

/// A laid out tree as shapes. Colours and dashes follow the subtree.
Sketch sketch_of(const TreeLayout& layout);

std::string dot_of(const TreeLayout& layout, std::string_view title);

}  // namespace swarmsmith
