#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "console/options.h"
#include "coordinator/campaign/campaign.h"

namespace swarmsmith::cli {

/// What of campaign files the command line may change; flags win over the environment
/// (SWARMSMITH_STORE), which wins over the file.
struct CampaignFlags {
  std::vector<std::string> files;
  std::optional<std::int64_t> budget;
  std::optional<std::int64_t> seed;
  std::string store;

  /// Declares FILE..., --budget, --seed and --store.
  void declare(Options& options, Options::Need files_needed);
  /// The campaigns with the flags in them, or nothing after having said what is wrong. Without a
  /// file it is the demo campaign. Several campaigns differ, each has a store of its own, and all
  /// are simulated or none is.
  std::optional<std::vector<Campaign>> read(Output& output) const;
};

/// What speaks against running these campaigns by one coordinator.
Expected<void> check_pool(const std::vector<Campaign>& campaigns);

}  // namespace swarmsmith::cli
