#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "coordinator/campaign/campaign.h"

namespace swarmsmith {

/// A campaign as the lines of its file, from which both the normalised text and the list of what
/// decides the answer are made: they cannot disagree.

struct SectionLine {
  std::string key;
  std::string value;    ///< as TOML
  bool decides = true;  ///< whether another value gives another answer
};

struct Section {
  std::string header;  ///< "[campaign]", "[[mission]]", "[mission.arena]"; empty for the top
  std::string prefix;  ///< of keys in the deciding list: "mission.aggregation.arena."
  std::vector<SectionLine> lines;
};

std::vector<Section> sections_of(const Campaign& campaign);

/// In double quotes, with what TOML and JSON both want escaped.
std::string quoted_text(std::string_view text);

}  // namespace swarmsmith
