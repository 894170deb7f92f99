#pragma once

#include <optional>
#include <string>

#include "base/expected.h"
#include "coordinator/campaign/campaign.h"
#include "coordinator/cli/design_worlds.h"
#include "coordinator/cli/store_argument.h"

namespace swarmsmith::cli {

/// A machine as a person names it, found.
struct NamedMachine {
  std::string text;                        ///< of the grammar
  CandidateId candidate;                   ///< none: given as text or file
  std::string design_mission;              ///< of a candidate: what its design calls its mission
  std::optional<CampaignMission> mission;  ///< of a candidate: its design's, as far as it is known
  std::string flavour;                     ///< of a candidate, else empty
  std::optional<TurnClock> turn_clock;     ///< of a candidate
  std::optional<Profile> profile;          ///< of a candidate: its campaign's
};

/// c and digits; a file of such a name is written ./c12.
bool is_candidate(const std::string& word);

/// `word` is the machine's text, a file that holds one (lines that begin with # are comments), or
/// a candidate `c812` of the store. NotFound when the store has no such candidate.
Expected<NamedMachine> find_machine(const std::string& word, const StoreArgument& store);

/// A candidate of the store, whose designs are `worlds`.
Expected<NamedMachine> machine_of_candidate(StoreReader& store, const DesignWorlds& worlds,
                                            CandidateId candidate);

}  // namespace swarmsmith::cli
