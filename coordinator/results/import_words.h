#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/expected.h"

namespace swarmsmith {

/// What missions of a file are called here: `--mission grid=grid_exploration` renames one,
/// `--mission aggregation` names that of rows which have none.
struct MissionWords {
  std::string of_all;  ///< for rows without one; may be empty
  std::map<std::string, std::string> renamed;

  /// The name here; empty when the row has none and there is none for all.
  std::string name_of(const std::string& in_file) const;
};

/// Errors: two names for all, one mission renamed twice, an empty name.
Expected<MissionWords> read_mission_words(const std::vector<std::string>& words);

}  // namespace swarmsmith
