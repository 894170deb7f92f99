#include <memory>
#include <optional>

#include "cli/commands/commands.h"
#include "cli/run/campaign_flags.h"
#include "cli/run/campaign_run.h"
#include "cli/run/pool_setup.h"
#include "coordinator/launchers/launch_text.h"

namespace swarmsmith::cli {

CommandRun declare_run(Options& options) {
  struct Arguments {
    CampaignFlags campaign;
    AccessFlags access;
    std::string workers;
    std::optional<std::int64_t> slots;
    bool ship = false;
    HttpFlags http;
  };
  auto arguments = std::make_shared<Arguments>();
  arguments->campaign.declare(options, Options::Need::Optional);
  options.text("--workers WHO", arguments->workers,
               "Who evaluates: auto (this host, all cores), N or local:N (N processes here, one "
               "core each), ssh:HOSTFILE, slurm or slurm:JOBSxCPUS");
  options.integer(
      "--slots", arguments->slots, {1, 10'000},
      "Parallel evaluations on this host (default: one per worker; with auto one per core)");
  options.flag("--ship", arguments->ship,
               "Copy the worker to the hosts of ssh and Slurm: nothing has to be installed there");
  arguments->access.declare(options);
  arguments->http.declare(options, "other pages only with --http");
  return [arguments](Output& output) {
    auto campaigns = arguments->campaign.read(output);
    if (!campaigns) return ExitCode::Usage;
    RunOptions run{.access = arguments->access};
    arguments->http.put(run, *campaigns);
    // Without the dashboard, the pages with numbers are not served either.
    if (arguments->http.no_dashboard && arguments->http.http.empty()) run.http.clear();
    if (!arguments->workers.empty()) {
      const auto launch = parse_workers(arguments->workers, campaigns->front().launch);
      if (!launch) {
        return fail(output, ExitCode::Usage,
                    Error{launch.error().kind, launch.error().message, "--workers"});
      }
      run.launch = *launch;
    }
    if (arguments->slots) {
      LaunchOptions launch = launch_of(campaigns->front(), run);
      if (launch.kind != LaunchOptions::Kind::Local) {
        return fail(output, ExitCode::Usage,
                    Error{ErrorKind::BadInput,
                          "applies to workers on this host; for jobs write slurm:JOBSxCPUS; a host "
                          "file has the slots of its hosts",
                          "--slots"});
      }
      launch.slots = *arguments->slots;
      run.launch = launch;
    }
    if (arguments->ship) {
      for (Campaign& campaign : *campaigns)
        campaign.launch.ship = true;
      if (run.launch) run.launch->ship = true;
      if (launch_of(campaigns->front(), run).kind == LaunchOptions::Kind::Local) {
        return fail(output, ExitCode::Usage,
                    Error{ErrorKind::BadInput,
                          "applies to workers on other hosts: ssh:HOSTFILE, slurm or "
                          "slurm:JOBSxCPUS",
                          "--ship"});
      }
    }
    return run_campaigns(output, *campaigns, run);
  };
}

}  // namespace swarmsmith::cli
