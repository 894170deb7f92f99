#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/expected.h"
#include "base/text/csv.h"
#include "sim/files/mission_file.h"

namespace swarmsmith {

/// What missions of a file are called here: `--mission grid=grid_exploration` renames one,
/// `--mission aggregation` names that of rows which have none. A mission file in place of a name
/// says what the mission is, too; without OLD= it is that of all rows.
struct MissionWords {
  std::string of_all;  ///< for rows without one; may be empty
  std::map<std::string, std::string> renamed;
  std::vector<MissionEntry> of_files;  ///< missions that files describe, by their names here
  bool all_of_file = false;            ///< `of_all` is one of these, and for rows with another name

  /// The name here; empty when the row has none and there is none for all.
  std::string name_of(const std::string& in_file) const;
  /// What a file says of the mission with this name here; null when none does.
  const MissionEntry* of_file(const std::string& name) const;
};

/// Errors: two names for all, one mission renamed twice, an empty name, what is wrong with a file.
OrErrors<MissionWords> read_mission_words(const std::vector<std::string>& words);

}  // namespace swarmsmith
