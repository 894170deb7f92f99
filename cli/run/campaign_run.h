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

/// Options for the workers, and for the address where remote workers find the coordinator.
struct RunOptions {
  /// The launcher of the workers; empty: from `workers` or the campaign.
  std::optional<LaunchOptions> launch;
  /// Number of worker processes on this host; empty: from the campaign; 0: no workers at all.
  std::optional<std::int64_t> workers;
  /// Evaluations at a time in each process; 0: the cores, shared among the processes.
  std::int64_t slots = 0;
  std::string bind;  ///< host:port; empty: from the campaigns, else a free port on loopback
  bool announce = false;
  AccessFlags access{};
  /// Whether to try the next ports if another program listens on the port of `bind`.
  bool next_port = false;
  std::string http{};  ///< host:port of the pages; empty: none
  bool http_next_port = false;
  std::string http_token_file{};
  std::vector<std::string> http_names{};  ///< other names of this host that requests may use
  /// Whether the dashboard is served. If it cannot be served, the run continues without it.
  bool dashboard = false;
  /// Whether an interrupted run can continue later; if not, its store is deleted.
  bool keeps_store = true;
};

/// Runs the campaigns to their ends on one pool of workers, continuing from their stores, and
/// prints the results of the finished ones. SIGINT and SIGTERM end the run so that the same command
/// can continue it later; a second signal ends it at once. Returns the worst exit code of the
/// campaigns.
ExitCode run_campaigns(Output& output, const std::vector<Campaign>& campaigns,
                       const RunOptions& options);

/// Like `run_campaigns`, but does not print results: reports progress to `listener` and prints
/// errors. Returns one exit code per campaign; all are equal if they could not begin.
std::vector<ExitCode> carry_out(Output& output, const std::vector<Campaign>& campaigns,
                                const RunOptions& options, RunListener& listener);

}  // namespace swarmsmith::cli
