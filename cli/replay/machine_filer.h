#pragma once

#include <optional>
#include <string>

#include "base/expected.h"
#include "base/id.h"
#include "cli/replay/design_worlds.h"
#include "sim/files/machine_file.h"
#include "storage/store.h"

namespace swarmsmith::cli {

/// Writes candidates of a store as machine files (sim/files/machine_file.h). Those of one design
/// are best asked for one after the other.
class MachineFiler {
 public:
  /// `store` must outlive the filer.
  static Expected<MachineFiler> open(StoreReader& store);

  /// A comment line with where the machine comes from, its head, its text; of a configuration of a
  /// parameter file its switches and values, without a head. NotFound when the store has no such
  /// candidate.
  Expected<std::string> text_of(CandidateId candidate);
  /// Without a flavour when the candidate is none of a flavour's machines.
  Expected<MachineHead> head_of(CandidateId candidate);

 private:
  MachineFiler(StoreReader& store, DesignWorlds worlds)
      : store_(&store), worlds_(std::move(worlds)) {}

  StoreReader* store_;
  DesignWorlds worlds_;
  std::optional<DesignWorld> world_;  ///< of the last design
  std::string campaign_;              ///< its campaign's digest
};

}  // namespace swarmsmith::cli
