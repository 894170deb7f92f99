#pragma once

#include <string>
#include <vector>

#include "coordinator/design/plans.h"
#include "storage/recover.h"

namespace swarmsmith {

/// What became of the races of a campaign when they were played from the scores that were found.
struct Rebuilt {
  DerivedRows derived;
  struct Design {
    DesignId id;
    DesignState state = DesignState::Waiting;
    std::int64_t used = 0;     ///< experiments, as far as the scores go
    std::int64_t ahead = 0;    ///< scores that were found of what comes later
    std::int64_t unasked = 0;  ///< scores of tests that were not asked for again
    std::size_t missing = 0;   ///< evaluations that it waits for
  };
  std::vector<Design> designs;
  /// A sentence each: races that cannot be played, or come to other steps than were found.
  std::vector<std::string> complaints;
};

/// Plays the designs from the scores that a damaged store still had. `steps` are those that it
/// had, with gaps, to compare with. Ids are those of a store of the campaign alone.
Rebuilt rebuild(std::vector<DesignPlan> plans, const std::vector<StoredScore>& scores,
                const std::vector<StoredStep>& steps, const std::vector<CommandRow>& commands);

}  // namespace swarmsmith
