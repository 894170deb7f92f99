#include <memory>

#include "coordinator/cli/campaign_run.h"
#include "coordinator/cli/commands.h"

namespace swarmsmith::cli {

Run declare_run(Options& options) {
  struct Arguments {
    CampaignFlags campaign;
    AccessFlags access;
    std::optional<std::int64_t> workers;
    bool no_dashboard = false;
    HttpFlags http;
  };
  auto arguments = std::make_shared<Arguments>();
  arguments->campaign.declare(options, Options::Need::Optional);
  options.integer("--workers", arguments->workers, {1, 1000},
                  "Local worker processes; they share the cores");
  options.flag("--no-dashboard", arguments->no_dashboard,
               "Accepted; this version has no dashboard to leave out");
  arguments->access.declare(options);
  arguments->http.declare(options, "default none");
  return [arguments](Output& output) {
    const auto campaign = arguments->campaign.read(output);
    if (!campaign) return ExitCode::Usage;
    RunOptions run{
        .workers = arguments->workers, .bind = campaign->bind, .access = arguments->access};
    arguments->http.put(run, "");
    return run_campaign(output, *campaign, run);
  };
}

}  // namespace swarmsmith::cli
