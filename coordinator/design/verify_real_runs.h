#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "storage/store.h"

namespace swarmsmith {

/// Scores the control cycles of every real run again, and compares with its latest scoring, bit for
/// bit; runs without a score (INVALID ones may have none) are left out. Returns how many were
/// scored; adds a sentence a fault to `complaints`.
std::int64_t verify_real_runs(StoreReader& store, std::vector<std::string>& complaints);

}  // namespace swarmsmith
