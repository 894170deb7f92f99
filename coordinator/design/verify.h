#pragma once

#include <string>
#include <vector>

#include "base/expected.h"
#include "coordinator/design/design_runner.h"
#include "storage/store.h"

namespace swarmsmith {

/// What a check of a store found.
struct Verification {
  std::vector<std::string> complaints;  ///< a sentence each; none when the store is clean
  std::int64_t designs = 0;
  std::int64_t finished = 0;
  std::int64_t evaluations = 0;
};

/// Plays every race of the store again from the stored scores, and compares what comes out with
/// what is stored: candidates, pairs, steps, eliminations, elites, budget, winner. A design that is
/// not finished is compared as far as it has come. Also evaluations with two different results,
/// SQLite's own integrity check, and whether the store's campaign is the one of `plans`.
Verification verify(StoreReader& store, std::vector<DesignPlan> plans);

/// The designs of a store, made from the campaign file that it keeps.
Expected<std::vector<DesignPlan>> plans_of(StoreReader& store);

}  // namespace swarmsmith
