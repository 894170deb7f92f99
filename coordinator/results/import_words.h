#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/expected.h"
#include "base/text/csv.h"
#include "sim/files/mission_file.h"

namespace swarmsmith {

/// How to name the missions of an imported file: `--mission grid=grid_exploration` renames one, and
/// `--mission aggregation` is the mission of rows that name none. A mission file instead of a name
/// also describes the mission; without OLD= it is the mission of all rows.
struct MissionWords {
  std::string of_all;  ///< the mission of rows that name none; may be empty
  std::map<std::string, std::string> renamed;
  std::vector<MissionEntry> of_files;  ///< missions from files, by their names here
  bool all_of_file = false;            ///< `of_all` is one of `of_files`, and is also the mission
                                       ///< of rows with another name

  /// The name that the mission gets here; empty if the row names none and there is no default.
  std::string name_of(const std::string& in_file) const;
  /// A file's description of the mission with this name; null if there is none.
  const MissionEntry* of_file(const std::string& name) const;
};

/// Errors: two names for all rows, a mission renamed twice, an empty name, a bad mission file.
OrErrors<MissionWords> read_mission_words(const std::vector<std::string>& words);

}  // namespace swarmsmith
