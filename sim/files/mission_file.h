#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "base/text/table_reader.h"
#include "base/text/toml_text.h"
#include "sim/mission/mission.h"

namespace swarmsmith {

/// Missions as TOML (docs/missions.md): a [[mission]] table of a campaign file, or a separate file
/// with the same keys at its top level.

/// A mission, with the number of tests for its designs.
struct MissionEntry {
  Mission mission;
  std::int64_t test_count = 100;  ///< fresh seeds on which each winner is scored after its race

  friend bool operator==(const MissionEntry&, const MissionEntry&) = default;
};

/// A mission, or all errors in its file; `where` of each is file:line:column.
using MissionOrErrors = tl::expected<MissionEntry, std::vector<Error>>;

/// Reads a mission file; names of image files in it are relative to its folder.
MissionOrErrors read_mission_file(const std::filesystem::path& file);

/// The same for a text; `file` only gives the name in error messages and the folder, and is not
/// opened.
MissionOrErrors parse_mission(std::string_view text, const std::filesystem::path& file);

/// The names of the built-in missions.
const std::vector<std::string>& mission_names();

/// `word` is the name of a built-in mission or a file: a word that ends in .toml or contains a
/// slash is a file, relative to `folder`.
MissionOrErrors find_mission(const std::string& word, const std::filesystem::path& folder);

/// Reads the [[mission]] tables of a campaign file in `folder`. Errors are added to the readers'
/// complaints.
std::vector<MissionEntry> read_missions(TableReader& root, const std::filesystem::path& folder);

/// The same for a text that came from another process: it must not name files.
std::vector<MissionEntry> read_sent_missions(TableReader& root);

/// The complete lines of a [[mission]]: a preset may change in a later version, but a stored text
/// must not. They read back to the same bits.
std::vector<Section> mission_sections(const MissionEntry& entry);

/// The mission as a complete separate file: parse_mission reads it back to the same bits.
std::string mission_text(const MissionEntry& entry);

}  // namespace swarmsmith
