#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "console/output.h"
#include "coordinator/campaign/campaign.h"
#include "coordinator/results/imported_world.h"
#include "coordinator/results/known_designs.h"
#include "storage/store.h"

namespace swarmsmith::cli {

/// What the machines of a design are simulated in, as far as its store says it.
struct DesignWorld {
  KnownDesign design;
  std::optional<CampaignMission> mission;  ///< nothing: its programs', or of an unknown name
  std::string flavour;
  const Flavour* own_flavour = nullptr;  ///< null: built in
  std::optional<TurnClock> turn_clock;
  std::optional<Profile> profile;  ///< the campaign's; nothing for imported machines
  /// Further ones of the campaign, and those under which candidates were evaluated outside of it.
  std::vector<Profile> further_profiles;
  int engine_version = 0;       ///< that made its scores; 0 when the store does not say
  bool has_programs = false;    ///< programs evaluate
  bool has_parameters = false;  ///< its candidates are parameters of a file, no machines
};

/// The worlds of all designs of a store: of a campaign's file, or, for imported machines, by their
/// flavour and the name of their mission, when that is built in.
class DesignWorlds {
 public:
  static Expected<DesignWorlds> read(StoreReader& store);

  /// Nothing when the store has no such design. BadInput when its campaign's file cannot be read by
  /// this version.
  Expected<std::optional<DesignWorld>> of(DesignId design) const;
  /// What only names tell apart: a sentence for each mission and profile that differs between
  /// campaigns and has one name. None of worlds that cannot be read, or are programs'.
  std::vector<std::string> mixed_names() const;
  const std::vector<KnownDesign>& designs() const { return designs_; }
  /// Of the store's first campaign.
  std::uint64_t seed() const { return seed_; }
  int first_engine_version() const { return files_.begin()->second.engine_version; }

 private:
  std::vector<KnownDesign> designs_;
  struct File {
    std::string text;  ///< empty for an imported campaign
    int engine_version = 0;
    /// Read once for all designs; `of` returns the error.
    std::optional<Expected<Campaign>> campaign{};
    std::optional<Expected<ImportedWorld>> imported{};
  };
  std::map<std::int64_t, File> files_;  ///< of the campaigns
  std::vector<Profile> kept_profiles_;  ///< see StoreReader
  std::uint64_t seed_ = 0;
};

/// Prints what names mix up in a store that just got another campaign. A store that cannot be read
/// says so elsewhere.
void warn_of_mixed_names(const std::string& store, Output& output);

}  // namespace swarmsmith::cli
