#pragma once

#include <string>

#include "analysis/comparison/comparison.h"

namespace swarmsmith {

/// For people: groups, pairs and ranks as aligned columns with six digits, notes below them, how it
/// was tested at the end.
std::string comparison_text(const Comparison& comparison);

}  // namespace swarmsmith
