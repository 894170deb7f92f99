#include <algorithm>
#include <memory>

#include "cli/commands/commands.h"
#include "cli/run/campaign_flags.h"
#include "cli/run/campaign_run.h"

namespace swarmsmith::cli {

CommandRun declare_serve(Options& options) {
  struct Arguments {
    CampaignFlags campaign;
    AccessFlags access;
    std::string bind;
    HttpFlags http;
  };
  auto arguments = std::make_shared<Arguments>();
  arguments->campaign.declare(options, Options::Need::Required);
  options.text("--bind HOST:PORT", arguments->bind,
               "Address and port for workers (default 127.0.0.1:5555, or the next free port)");
  arguments->http.declare(options, "the other pages stay");
  arguments->access.declare(options);
  return [arguments](Output& output) {
    const auto campaigns = arguments->campaign.read(output);
    if (!campaigns) return ExitCode::Usage;
    RunOptions run{
        .workers = 0, .bind = arguments->bind, .announce = true, .access = arguments->access};
    if (run.bind.empty() && std::ranges::all_of(*campaigns, &std::string::empty, &Campaign::bind)) {
      run.bind = "127.0.0.1:5555";
      run.next_port = true;
    }
    arguments->http.put(run, *campaigns);
    return run_campaigns(output, *campaigns, run);
  };
}

}  // namespace swarmsmith::cli
