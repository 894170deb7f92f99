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

/// A mission of a store, with the seeds on which its winners were scored after their races.
struct ScoredMission {
  std::string name;  ///< with "-2" and so on where a merged store means several things by a name
  Mission mission;
  std::set<std::int64_t> seeds;
};

struct MissionFilter {
  std::string mission;             ///< empty: any
  std::optional<DesignId> design;  ///< only that one's
};

/// In the order of the designs. Left out are missions that programs evaluate, and names that this
/// version knows nothing of.
Expected<std::vector<ScoredMission>> scored_missions(StoreReader& store,
                                                     const MissionFilter& filter = {});

/// Where the robots started, or where the patches lay, in each of the seeds: a table that `evaluate
/// --starts` or `--patches` reads. No patches: an empty text.
Expected<std::string> starts_table(const ScoredMission& scored);
Expected<std::string> patches_table(const ScoredMission& scored);

}  // namespace swarmsmith::cli
