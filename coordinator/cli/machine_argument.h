#pragma once

#include <optional>
#include <string>

#include "base/expected.h"
#include "coordinator/campaign/campaign.h"
#include "coordinator/cli/store_argument.h"

namespace swarmsmith::cli {

/// A machine as a person names it, found.
struct NamedMachine {
  std::string text;                        ///< of the grammar
  std::optional<CampaignMission> mission;  ///< of a candidate: its design's
  std::string flavour;                     ///< of a candidate, else empty
  std::optional<TurnClock> turn_clock;     ///< of a candidate
  std::optional<Profile> profile;          ///< of a candidate: its campaign's
};

/// `word` is the machine's text, a file that holds one (lines that begin with # are comments), or
/// a candidate `c812` of the store. NotFound when the store has no such candidate.
Expected<NamedMachine> find_machine(const std::string& word, const StoreArgument& store);

}  // namespace swarmsmith::cli
