#pragma once

#include <string>

#include "analysis/comparison/comparison.h"

namespace swarmsmith {

/// The comparison for people: groups, pairs and ranks as aligned columns with six digits, notes
/// below them, and at the end a description of the tests.
std::string comparison_text(const Comparison& comparison);

}  // namespace swarmsmith
