#pragma once

#include <string>
#include <vector>

#include "base/text/toml_text.h"
#include "coordinator/campaign/campaign.h"

namespace swarmsmith {

/// The lines that only campaigns with programs have; reading them gives the same values, without
/// any other file.

std::vector<Section> target_mission_sections(const CampaignMission& mission);
Section parameter_file_section(const Method& method);
Section target_section(const Target& target);

/// A TOML array of texts.
std::string array_of(const std::vector<std::string>& texts);

/// A text in TOML, as a multi-line literal if TOML allows it.
std::string block_text(const std::string& text);

}  // namespace swarmsmith
