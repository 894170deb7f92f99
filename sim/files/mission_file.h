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

/// Missions as TOML (docs/missions.md): a [[mission]] of a campaign file, or a file of its own with
/// the same keys at its top.

/// A mission and how its designs are judged.
struct MissionEntry {
  Mission mission;
  std::int64_t test_count = 100;  ///< fresh seeds on which each winner is scored after its race

  friend bool operator==(const MissionEntry&, const MissionEntry&) = default;
};

/// A mission, or everything that is wrong with its file: `where` is file:line:column.
using MissionOrErrors = tl::expected<MissionEntry, std::vector<Error>>;

/// A mission file; images that it names are relative to its folder.
MissionOrErrors read_mission_file(const std::filesystem::path& file);

/// The same for a text; `file` gives the name for errors and the folder, and is not read.
MissionOrErrors parse_mission(std::string_view text, const std::filesystem::path& file);

/// Those of the built-in missions.
const std::vector<std::string>& mission_names();

/// `word` is the name of a built-in mission, or a file: what ends in .toml, or has a slash;
/// relative to `folder`.
MissionOrErrors find_mission(const std::string& word, const std::filesystem::path& folder);

/// The [[mission]] tables of a campaign file in `folder`. What is wrong goes to the readers'
/// complaints.
std::vector<MissionEntry> read_missions(TableReader& root, const std::filesystem::path& folder);

/// The same of a text that came from another process: it may name no file.
std::vector<MissionEntry> read_sent_missions(TableReader& root);

/// The lines of a [[mission]], whole: a preset may change in a later version, a stored text must
/// not. Reads back to the same bits.
std::vector<Section> mission_sections(const MissionEntry& entry);

/// The mission as a file of its own that says everything: parse_mission reads the same bits back.
std::string mission_text(const MissionEntry& entry);

}  // namespace swarmsmith
