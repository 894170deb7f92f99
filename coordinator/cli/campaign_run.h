#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "coordinator/campaign/campaign.h"
#include "coordinator/cli/access_flags.h"
#include "coordinator/cli/options.h"
#include "coordinator/cli/run_listener.h"

namespace swarmsmith::cli {

/// What of a campaign file the command line may change; flags win over the environment
/// (SWARMSMITH_STORE), which wins over the file.
struct CampaignFlags {
  std::string file;
  std::optional<std::int64_t> budget;
  std::optional<std::int64_t> seed;
  std::string store;

  /// Declares FILE, --budget, --seed and --store.
  void declare(Options& options, Options::Need file_needed);
  /// The campaign with the flags in it, or nothing after having said what is wrong. Without a file
  /// it is the demo campaign.
  std::optional<Campaign> read(Output& output) const;
};

/// Who evaluates, and where workers from elsewhere find the coordinator.
struct RunOptions {
  /// Worker processes that this one starts; none: the campaign's number, 0: none at all.
  std::optional<std::int64_t> workers;
  /// Evaluations at a time of each; 0: the cores, shared among the processes.
  std::int64_t slots = 0;
  std::string bind;  ///< host:port; empty: a free port on loopback
  bool announce = false;
  AccessFlags access{};
  /// When another program listens on the port of `bind`, one of the next ones will do.
  bool next_port = false;
  std::string http{};  ///< host:port of the pages; empty: none
  bool http_next_port = false;
  std::string http_token_file{};
  /// Whether an interrupted run goes on later; else its store is thrown away.
  bool keeps_store = true;
};

/// Where a coordinator shows what it does.
struct HttpFlags {
  std::string http;
  std::string token_file;

  /// Declares --http and --http-token-file.
  void declare(Options& options, const std::string& otherwise);
  /// `otherwise` is where pages are served when nobody says; empty for nowhere.
  void put(RunOptions& run, const std::string& otherwise) const;
};

/// Runs the campaign to its end, going on where its store stands, and prints its result. SIGINT and
/// SIGTERM end it so that the same command goes on later; a second one ends it at once.
ExitCode run_campaign(Output& output, const Campaign& campaign, const RunOptions& options);

/// The same without printing a result: `listener` is told how it goes, errors are explained.
ExitCode carry_out(Output& output, const Campaign& campaign, const RunOptions& options,
                   RunListener& listener);

}  // namespace swarmsmith::cli
