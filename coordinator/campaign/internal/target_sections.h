#pragma once

#include <string>
#include <vector>

#include "base/text/toml_text.h"
#include "coordinator/campaign/campaign.h"

namespace swarmsmith {

/// The lines of what only campaigns with programs have; they read back to the same values, and need
/// no other file.

std::vector<Section> target_mission_sections(const CampaignMission& mission);
Section parameter_file_section(const Method& method);
Section target_section(const Target& target);

/// A TOML array of texts.
std::string array_of(const std::vector<std::string>& texts);

/// A text as TOML, over several lines as it is where TOML can hold it so.
std::string block_text(const std::string& text);

}  // namespace swarmsmith
