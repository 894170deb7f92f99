#pragma once

#include <string>

#include "analysis/comparison/comparison.h"

namespace swarmsmith::cli {

/// One JSON object, as docs/command-line.md describes it under `compare`.
std::string comparison_json(const Comparison& comparison);

}  // namespace swarmsmith::cli
