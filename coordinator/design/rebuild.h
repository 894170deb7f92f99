#pragma once

#include <string>
#include <vector>

#include "coordinator/design/plans.h"
#include "storage/recover.h"

namespace swarmsmith {

/// The result of replaying a campaign's races from recovered scores.
struct Rebuilt {
  DerivedRows derived;
  struct Design {
    DesignId id;
    DesignState state = DesignState::Waiting;
    std::int64_t used = 0;     ///< experiments, as far as there are scores
    std::int64_t ahead = 0;    ///< recovered scores that come after the point the race reached
    std::int64_t unasked = 0;  ///< scores of tests that were not asked for again
    std::size_t missing = 0;   ///< evaluations that it still needs
  };
  std::vector<Design> designs;
  /// A sentence for each race that cannot be replayed or whose steps differ from the recovered
  /// ones.
  std::vector<std::string> complaints;
};

/// Replays the designs from the scores that were recovered from a damaged store. `steps` are the
/// recovered steps, with gaps, for comparison. Ids are those of a store with only this campaign.
Rebuilt rebuild(std::vector<DesignPlan> plans, const std::vector<StoredScore>& scores,
                const std::vector<StoredStep>& steps, const std::vector<CommandRow>& commands);

}  // namespace swarmsmith
