#pragma once

#include <optional>
#include <string>

#include "base/expected.h"
#include "base/id.h"
#include "cli/replay/design_worlds.h"
#include "sim/files/machine_file.h"
#include "storage/store.h"

namespace swarmsmith::cli {

/// Writes candidates of a store as machine files (sim/files/machine_file.h). Fastest if candidates
/// of the same design follow each other.
class MachineFiler {
 public:
  /// `store` must outlive the filer.
  static Expected<MachineFiler> open(StoreReader& store);

  /// A comment line with the machine's origin, its head, its text. For a configuration of a
  /// parameter file: its switches and values, without a head. NotFound if the store has no such
  /// candidate.
  Expected<std::string> text_of(CandidateId candidate);
  /// The head has no flavour if the candidate is not a machine of a flavour.
  Expected<MachineHead> head_of(CandidateId candidate);

 private:
  MachineFiler(StoreReader& store, DesignWorlds worlds)
      : store_(&store), worlds_(std::move(worlds)) {}

  StoreReader* store_;
  DesignWorlds worlds_;
  std::optional<DesignWorld> world_;  ///< of the design asked for last
  std::string campaign_;              ///< digest of its campaign
};

}  // namespace swarmsmith::cli
