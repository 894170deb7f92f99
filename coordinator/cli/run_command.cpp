#include <memory>

#include "coordinator/cli/campaign_flags.h"
#include "coordinator/cli/campaign_run.h"
#include "coordinator/cli/commands.h"
#include "coordinator/cli/http_flags.h"
#include "coordinator/launchers/launch_text.h"

namespace swarmsmith::cli {

Run declare_run(Options& options) {
  struct Arguments {
    CampaignFlags campaign;
    AccessFlags access;
    std::string workers;
    bool no_dashboard = false;
    HttpFlags http;
  };
  auto arguments = std::make_shared<Arguments>();
  arguments->campaign.declare(options, Options::Need::Optional);
  options.text("--workers", arguments->workers,
               "Who evaluates: auto (this host, all cores), N or local:N (that many processes "
               "here, which share the cores), ssh:HOSTFILE, slurm or slurm:JOBSxCPUS");
  options.flag("--no-dashboard", arguments->no_dashboard,
               "Accepted; this version has no dashboard to leave out");
  arguments->access.declare(options);
  arguments->http.declare(options, "default none");
  return [arguments](Output& output) {
    const auto campaigns = arguments->campaign.read(output);
    if (!campaigns) return ExitCode::Usage;
    RunOptions run{.access = arguments->access};
    arguments->http.put(run, "");
    if (!arguments->workers.empty()) {
      const auto launch = parse_workers(arguments->workers, campaigns->front().launch);
      if (!launch) {
        return fail(output, ExitCode::Usage,
                    Error{launch.error().kind, launch.error().message, "--workers"});
      }
      run.launch = *launch;
    }
    return run_campaigns(output, *campaigns, run);
  };
}

}  // namespace swarmsmith::cli
