#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/expected.h"
#include "base/id.h"
#include "sim/mission/mission.h"
#include "storage/store.h"

namespace swarmsmith::cli {

/// A mission of a store, with the seeds on which its winners were evaluated after their races.
struct ScoredMission {
  std::string name;  ///< with "-2" and so on if missions of a merged store share a name
  Mission mission;
  std::set<std::int64_t> seeds;
};

struct MissionFilter {
  std::string mission;             ///< empty: all missions
  std::optional<DesignId> design;  ///< only the mission of this design
};

/// In the order of the designs. Leaves out missions that programs evaluate, and mission names that
/// this version does not know.
Expected<std::vector<ScoredMission>> scored_missions(StoreReader& store,
                                                     const MissionFilter& filter = {});

/// The starts of the robots, or the places of the patches, for each seed, as a table for `evaluate
/// --starts` or `--patches`. Empty text if there are no patches.
Expected<std::string> starts_table(const ScoredMission& scored);
Expected<std::string> patches_table(const ScoredMission& scored);

}  // namespace swarmsmith::cli
