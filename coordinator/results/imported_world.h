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

/// What machines of elsewhere are made of and simulated in, as far as their files say it and no
/// program knows it by name: the text `file` of the campaign that they become. It has the sections
/// of a campaign file, but it is none: nothing was raced.
struct ImportedWorld {
  std::vector<MissionEntry> missions;
  std::optional<Profile> profile;
  const Flavour* own_flavour = nullptr;  ///< see kept_flavour; null: built in

  friend bool operator==(const ImportedWorld&, const ImportedWorld&) = default;
};

std::vector<Section> imported_sections(const ImportedWorld& world);

/// Whether a campaign's `file` is such a text.
bool is_imported_text(std::string_view text);

/// Empty for a world without any of it; else read_imported_world gives the same bits.
std::string imported_text(const ImportedWorld& world);

/// BadInput when this version cannot read it. May name no file.
Expected<ImportedWorld> read_imported_world(std::string_view text);

}  // namespace swarmsmith
