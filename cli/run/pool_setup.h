#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cli/run/campaign_run.h"
#include "coordinator/campaign/campaign.h"
#include "coordinator/service/http_server.h"
#include "coordinator/service/service.h"

namespace swarmsmith::cli {

// What flags and campaign files say of the pool that campaigns share: address, rules, workers,
// pages.

/// Workers and the address are of the pool: files that say different things are of no help.
Expected<void> check_agreement(const std::vector<Campaign>& campaigns, const RunOptions& options);

/// Who starts workers: `--workers`, or the file.
LaunchOptions launch_of(const Campaign& campaign, const RunOptions& options);

/// Where the coordinator listens, as tcp://HOST:PORT.
std::string bind_of(const RunOptions& options);

/// Address, scenario and policies, without keys and numbers of workers. The campaigns agree about
/// everything but their scenarios and policies (`check_agreement`).
ServiceOptions service_options(const std::vector<const Campaign*>& campaigns,
                               const RunOptions& options);

/// On the address of `options`, or, with `next_port`, on one of the next ports where that will do.
Expected<std::unique_ptr<Service>> open_service(ServiceOptions options,
                                                const std::vector<ServiceCampaign>& campaigns,
                                                bool next_port);

/// Pages over HTTP with this site (null: none), where they were asked for; else null. `act_token`:
/// see HttpOptions.
Expected<std::unique_ptr<HttpServer>> open_pages(const RunOptions& options,
                                                 std::shared_ptr<HttpSite> site,
                                                 const std::string& act_token);

}  // namespace swarmsmith::cli
