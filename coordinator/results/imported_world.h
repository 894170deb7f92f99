#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "base/text/toml_text.h"
#include "sim/control/flavour.h"
#include "sim/engine/profile.h"
#include "sim/files/mission_file.h"

namespace swarmsmith {

/// The missions, profile and flavour of imported machines, if their files describe them and they
/// are not built in. The text is stored as the `file` of the imported campaign. It has the sections
/// of a campaign file, but it is not one, because nothing was raced.
struct ImportedWorld {
  std::vector<MissionEntry> missions;
  std::optional<Profile> profile;
  const Flavour* own_flavour = nullptr;  ///< see kept_flavour; null: built in

  friend bool operator==(const ImportedWorld&, const ImportedWorld&) = default;
};

std::vector<Section> imported_sections(const ImportedWorld& world);

/// Whether a campaign's `file` is such a text.
bool is_imported_text(std::string_view text);

/// Empty for an empty world; otherwise read_imported_world restores it bit by bit.
std::string imported_text(const ImportedWorld& world);

/// BadInput if this version cannot read the text. The text must not refer to files.
Expected<ImportedWorld> read_imported_world(std::string_view text);

}  // namespace swarmsmith
