#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/run/campaign_run.h"
#include "console/options.h"
#include "console/output.h"
#include "coordinator/campaign/campaign.h"

namespace swarmsmith::cli {

/// Reads the campaign file, or prints all its errors (exit code 2). A `budget` from a flag replaces
/// the budget of the file.
std::optional<Campaign> read_or_complain(const std::string& file, Output& output,
                                         std::optional<std::int64_t> budget = std::nullopt);

/// The keys of campaign files that the command line may change; flags win over the environment
/// (SWARMSMITH_STORE), which wins over the file.
struct CampaignFlags {
  std::vector<std::string> files;
  std::optional<std::int64_t> budget;
  std::optional<std::int64_t> seed;
  std::string store;

  /// Declares FILE..., --budget, --seed and --store.
  void declare(Options& options, Options::Need files_needed);
  /// The campaigns with the flags applied, or nothing after printing the error. Without a file, the
  /// demo campaign. Several campaigns must differ and have different stores, and either all or none
  /// of them must be simulated.
  std::optional<std::vector<Campaign>> read(Output& output) const;
};

/// The reason why one coordinator cannot run these campaigns, if there is one.
Expected<void> check_pool(const std::vector<Campaign>& campaigns);

/// Flags for the HTTP pages of a coordinator.
struct HttpFlags {
  std::string http;
  std::string token_file;
  std::vector<std::string> names;
  bool no_dashboard = false;

  /// Declares --http, --http-token-file, --http-name and --no-dashboard. `without_dashboard`: what
  /// becomes of the other pages then.
  void declare(Options& options, const std::string& without_dashboard);
  /// Sets the address: from the command line, else from the campaigns' files, else 127.0.0.1:8347
  /// or the next free port.
  void put(RunOptions& run, const std::vector<Campaign>& campaigns) const;
};

}  // namespace swarmsmith::cli
