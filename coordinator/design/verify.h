#pragma once

#include <string>
#include <vector>

#include "base/expected.h"
#include "coordinator/design/plans.h"
#include "storage/store.h"

namespace swarmsmith {

/// What a check of a store found.
struct Verification {
  std::vector<std::string> complaints;  ///< a sentence each; none when the store is clean
  std::int64_t designs = 0;
  std::int64_t finished = 0;
  std::int64_t evaluations = 0;
  std::int64_t real_runs = 0;  ///< that have a score
};

/// Plays every race of the store again from the stored scores, and compares what comes out with
/// what is stored: candidates, pairs, steps, eliminations, elites, budget, winner. A design that is
/// not finished is compared as far as it has come. Also evaluations with two different results,
/// SQLite's own integrity check, and whether each campaign is the one of the file that the store
/// keeps of it; and the scores of real runs, from their control cycles. Of several campaigns each
/// is looked at as if it were alone, and so are the ids in its complaints. Imported ones have no
/// races. Fails when a campaign cannot be played by this program at all.
Expected<Verification> verify(StoreReader& store);

/// The designs of a store's only campaign, made from the file that it keeps.
Expected<std::vector<DesignPlan>> plans_of(const CampaignRow& row);

}  // namespace swarmsmith
