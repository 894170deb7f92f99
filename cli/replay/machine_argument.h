#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "cli/arguments/store_argument.h"
#include "cli/replay/design_worlds.h"
#include "coordinator/campaign/campaign.h"

namespace swarmsmith::cli {

/// A machine that a person named, found.
struct NamedMachine {
  std::string text;       ///< in the text grammar
  CandidateId candidate;  ///< empty: given as text or file
  std::string name;   ///< for a machine of a file: d3-c812, or its name in the file; may be empty
  std::string place;  ///< for a machine of a file: file:line
  std::string design_mission;  ///< for a candidate: its design's name for the mission
  // For a candidate the values of its design, for a file the values in its head, as far as known.
  std::optional<CampaignMission> mission;
  std::string flavour;
  const Flavour* own_flavour = nullptr;  ///< null: built in
  std::optional<TurnClock> turn_clock;
  std::optional<Profile> profile;
  std::vector<Profile> further_profiles;  ///< for a candidate: other profiles that its store knows
  std::string seeds;  ///< for a machine of a file: seeds of the tests whose scores its store has
};

/// Whether the word is c and digits. A file with such a name must be written as ./c12.
bool is_candidate(const std::string& word);

/// `word` is a machine's text, a file of machines (sim/files/machine_file.h), or a candidate `c812`
/// of the store. NotFound if the store has no such candidate. Prints all errors of a file except
/// the last one, which is returned.
Expected<std::vector<NamedMachine>> find_machines(const std::string& word,
                                                  const StoreArgument& store, Output& output);

/// A candidate of the store; `worlds` are the settings of the store's designs.
Expected<NamedMachine> machine_of_candidate(StoreReader& store, const DesignWorlds& worlds,
                                            CandidateId candidate);

}  // namespace swarmsmith::cli
