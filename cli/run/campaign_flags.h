#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "console/options.h"
#include "coordinator/campaign/campaign.h"

namespace swarmsmith::cli {

/// The keys of campaign files that the command line may change; flags win over the environment
/// (SWARMSMITH_STORE), which wins over the file.
struct CampaignFlags {
  std::vector<std::string> files;
  std::optional<std::int64_t> budget;
  std::optional<std::int64_t> seed;
  std::string store;

  /// Declares FILE..., --budget, --seed and --store.
  void declare(Options& options, Options::Need files_needed);
  /// The campaigns with the flags applied, or nothing after printing the error. Without a file it
  /// is the demo campaign. Several campaigns must differ, have a store each, and be all simulated
  /// or none.
  std::optional<std::vector<Campaign>> read(Output& output) const;
};

/// The reason why one coordinator cannot run these campaigns, if any.
Expected<void> check_pool(const std::vector<Campaign>& campaigns);

}  // namespace swarmsmith::cli
