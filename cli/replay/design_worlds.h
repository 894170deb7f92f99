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

/// The simulation settings for the machines of a design, as far as its store has them.
struct DesignWorld {
  KnownDesign design;
  std::optional<CampaignMission>
      mission;  ///< empty if programs evaluate, or if the mission's name is unknown
  std::string flavour;
  const Flavour* own_flavour = nullptr;  ///< null: built in
  std::optional<TurnClock> turn_clock;
  std::optional<Profile> profile;  ///< of the campaign; empty for imported machines
  /// Other profiles: further ones of the campaign, and those used for evaluations outside the
  /// campaign.
  std::vector<Profile> further_profiles;
  int engine_version = 0;       ///< version that made its scores; 0 if the store does not say it
  bool has_programs = false;    ///< programs evaluate
  bool has_parameters = false;  ///< its candidates are parameters of a file, not machines
};

/// The settings of all designs of a store: from a campaign's file, or, for imported machines, from
/// their flavour and the name of their mission, if it is built in.
class DesignWorlds {
 public:
  static Expected<DesignWorlds> read(StoreReader& store);

  /// Empty if the store has no such design. BadInput if this version cannot read its campaign's
  /// file.
  Expected<std::optional<DesignWorld>> of(DesignId design) const;
  /// A sentence for each mission and profile that has the same name in several campaigns but
  /// differs between them. Skips settings that cannot be read, and designs with programs.
  std::vector<std::string> mixed_names() const;
  const std::vector<KnownDesign>& designs() const { return designs_; }
  /// Seed of the store's first campaign.
  std::uint64_t seed() const { return seed_; }
  int first_engine_version() const { return files_.begin()->second.engine_version; }

 private:
  std::vector<KnownDesign> designs_;
  struct File {
    std::string text;  ///< empty for an imported campaign
    int engine_version = 0;
    /// Read once for all designs; an error is returned by `of`.
    std::optional<Expected<Campaign>> campaign{};
    std::optional<Expected<ImportedWorld>> imported{};
  };
  std::map<std::int64_t, File> files_;  ///< by campaign
  std::vector<Profile> kept_profiles_;  ///< see StoreReader
  std::uint64_t seed_ = 0;
};

/// Warns about missions and profiles with the same name that differ, in a store to which a campaign
/// was just added. Says nothing about a store that cannot be read; other code reports that.
void warn_of_mixed_names(const std::string& store, Output& output);

}  // namespace swarmsmith::cli
