#include <memory>

#include "coordinator/cli/campaign_flags.h"
#include "coordinator/cli/campaign_run.h"
#include "coordinator/cli/commands.h"

namespace swarmsmith::cli {

Run declare_run(Options& options) {
  struct Arguments {
    CampaignFlags campaign;
    AccessFlags access;
    std::optional<std::int64_t> workers;
    bool no_dashboard = false;
  };
  auto arguments = std::make_shared<Arguments>();
  arguments->campaign.declare(options, Options::Need::Optional);
  options.integer("--workers", arguments->workers, {1, 1000},
                  "Local worker processes; they share the cores");
  options.flag("--no-dashboard", arguments->no_dashboard,
               "Accepted; this version has no dashboard to leave out");
  arguments->access.declare(options);
  return [arguments](Output& output) {
    const auto campaigns = arguments->campaign.read(output);
    if (!campaigns) return ExitCode::Usage;
    return run_campaigns(output, *campaigns, {.workers = arguments->workers, .access = arguments->access});
  };
}

}  // namespace swarmsmith::cli
