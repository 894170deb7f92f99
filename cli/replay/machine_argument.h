#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "cli/arguments/store_argument.h"
#include "cli/replay/design_worlds.h"
#include "coordinator/campaign/campaign.h"

namespace swarmsmith::cli {

/// A machine as a person names it, found.
struct NamedMachine {
  std::string text;            ///< of the grammar
  CandidateId candidate;       ///< none: given as text or file
  std::string name;            ///< of a file: d3-c812, or as the file calls it; may be empty
  std::string place;           ///< of a file: file:line
  std::string design_mission;  ///< of a candidate: what its design calls its mission
  // Of a candidate its design's, of a file its head's, as far as they say it.
  std::optional<CampaignMission> mission;
  std::string flavour;
  const Flavour* own_flavour = nullptr;  ///< null: built in
  std::optional<TurnClock> turn_clock;
  std::optional<Profile> profile;
  std::vector<Profile> further_profiles;  ///< of a candidate: others that its store knows
  std::string seeds;  ///< of a file: those of the tests whose scores its store has
};

/// c and digits; a file of such a name is written ./c12.
bool is_candidate(const std::string& word);

/// `word` is a machine's text, a file of machines (sim/files/machine_file.h), or a candidate `c812`
/// of the store. NotFound when the store has no such candidate. All that is wrong with a file but
/// the last thing is printed, the last is the error.
Expected<std::vector<NamedMachine>> find_machines(const std::string& word,
                                                  const StoreArgument& store, Output& output);

/// A candidate of the store, whose designs are `worlds`.
Expected<NamedMachine> machine_of_candidate(StoreReader& store, const DesignWorlds& worlds,
                                            CandidateId candidate);

}  // namespace swarmsmith::cli
