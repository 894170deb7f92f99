#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/arguments/access_flags.h"
#include "cli/output/run_listener.h"
#include "console/options.h"
#include "coordinator/campaign/campaign.h"
#include "coordinator/launchers/launch_options.h"

namespace swarmsmith::cli {

/// Who evaluates, and where workers from elsewhere find the coordinator.
struct RunOptions {
  /// Who starts workers; none: as `workers` or the campaign have it.
  std::optional<LaunchOptions> launch;
  /// Worker processes of this host; none: as the campaign has it, 0: no workers at all.
  std::optional<std::int64_t> workers;
  /// Evaluations at a time of each; 0: the cores, shared among the processes.
  std::int64_t slots = 0;
  std::string bind;  ///< host:port; empty: as the campaigns have it, else a free port on loopback
  bool announce = false;
  AccessFlags access{};
  /// Whether to try the next ports when another program listens on the port of `bind`.
  bool next_port = false;
  std::string http{};  ///< host:port of the pages; empty: none
  bool http_next_port = false;
  std::string http_token_file{};
  std::vector<std::string> http_names{};  ///< what requests may call this host besides
  /// Whether the dashboard is among the pages; its absence ends no run.
  bool dashboard = false;
  /// Whether an interrupted run can continue later; else its store is deleted.
  bool keeps_store = true;
};

/// Runs the campaigns to their ends on one pool of workers, continuing from their stores, and
/// prints the results of the finished ones. SIGINT and SIGTERM end it so that the same command can
/// continue later; a second one ends it at once. Returns the worst exit code of the campaigns.
ExitCode run_campaigns(Output& output, const std::vector<Campaign>& campaigns,
                       const RunOptions& options);

/// The same without printing results: reports progress to `listener` and explains errors. Returns
/// one exit code per campaign; all are equal if they could not begin.
std::vector<ExitCode> carry_out(Output& output, const std::vector<Campaign>& campaigns,
                                const RunOptions& options, RunListener& listener);

}  // namespace swarmsmith::cli
