#pragma once

#include <string>
#include <string_view>

#include "analysis/machines/internal/sketch.h"
#include "analysis/machines/tree_layout.h"

namespace swarmsmith {

/// The shapes of a tree with a layout. Each subtree has its own colour and dashes.
Sketch sketch_of(const TreeLayout& layout);

std::string dot_of(const TreeLayout& layout, std::string_view title);

}  // namespace swarmsmith
