#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cli/run/campaign_run.h"
#include "coordinator/campaign/campaign.h"
#include "coordinator/service/http_server.h"
#include "coordinator/service/service.h"

namespace swarmsmith::cli {

// Settings from flags and campaign files for the pool that campaigns share: address, rules,
// workers, pages.

/// Checks that the files agree about workers and address, which belong to the whole pool.
Expected<void> check_agreement(const std::vector<Campaign>& campaigns, const RunOptions& options);

/// The launcher of the workers: from `--workers`, or from the file.
LaunchOptions launch_of(const Campaign& campaign, const RunOptions& options);

/// The address on which the coordinator listens, as tcp://HOST:PORT.
std::string bind_of(const RunOptions& options);

/// Address, scenario and policies, without keys and numbers of workers. The campaigns agree about
/// everything except their scenarios and policies (`check_agreement`).
ServiceOptions service_options(const std::vector<const Campaign*>& campaigns,
                               const RunOptions& options);

/// Opens the service on the address of `options`, or with `next_port` on one of the next ports if
/// that one is in use.
Expected<std::unique_ptr<Service>> open_service(ServiceOptions options,
                                                const std::vector<ServiceCampaign>& campaigns,
                                                bool next_port);

/// Serves pages over HTTP with this site (null: none), if they are wanted; else returns null.
/// `act_token`: see HttpOptions.
Expected<std::unique_ptr<HttpServer>> open_pages(const RunOptions& options,
                                                 std::shared_ptr<HttpSite> site,
                                                 const std::string& act_token);

}  // namespace swarmsmith::cli
