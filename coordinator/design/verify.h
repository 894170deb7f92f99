#pragma once

#include <string>
#include <vector>

#include "base/expected.h"
#include "coordinator/design/plans.h"
#include "storage/store.h"

namespace swarmsmith {

/// The result of checking a store.
struct Verification {
  std::vector<std::string> complaints;  ///< a sentence each; empty if the store is correct
  std::int64_t designs = 0;
  std::int64_t finished = 0;
  std::int64_t evaluations = 0;
  std::int64_t real_runs = 0;  ///< real runs that have a score
};

/// Replays every race of the store from the stored scores, and compares the results with the stored
/// ones: candidates, pairs, steps, eliminations, elites, budget, winner. An unfinished design is
/// compared up to its last step. Also checks for evaluations with two different results, runs
/// SQLite's own integrity check, checks that each campaign agrees with the campaign file in the
/// store, and recomputes the scores of real runs from their control cycles. If there are several
/// campaigns, each one is checked as if it were alone, and the ids in its complaints are numbered
/// in the same way. Imported campaigns have no races. Fails if this program cannot replay a
/// campaign at all.
Expected<Verification> verify(StoreReader& store);

/// The designs of a store's only campaign, made from its stored campaign file.
Expected<std::vector<DesignPlan>> plans_of(const CampaignRow& row);

}  // namespace swarmsmith
