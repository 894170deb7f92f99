#include "cli/run/pool_setup.h"

#include "coordinator/campaign/campaign_rows.h"
#include "coordinator/campaign/campaign_text.h"
#include "coordinator/service/http_address.h"
#include "proto/access/address.h"
#include "proto/scenario/scenario.h"
#include "proto/socket.h"
#include "sim/engine/self_test.h"
#include "sim/engine/simulate.h"

namespace swarmsmith::cli {
namespace {

WorkerScenario scenario_of(const Campaign& campaign) {
  WorkerScenario scenario{.campaign_digest = campaign_digest(campaign),
                          .engine_version = engine_version_of(campaign),
                          .profile = campaign.profile,
                          .test_profiles = campaign.test_profiles,
                          .target = campaign.target};
  if (campaign.target) {
    for (const CampaignMission& mission : campaign.missions) {
      InstanceTexts& texts = scenario.instances.emplace_back(mission.instances);
      // Without test instances, elites are tested on fresh seeds of the training instances.
      if (texts.test.empty() && mission.test_count > 0) texts.test = texts.training;
    }
    return scenario;
  }
  for (const CampaignMission& mission : campaign.missions) {
    scenario.missions.push_back(mission.mission);
  }
  for (const Method& method : campaign.methods)
    scenario.methods.push_back({.flavour = method.flavour,
                                .turn_clock = method.turn_clock,
                                .own_flavour = method.own_flavour});
  return scenario;
}

CampaignPolicy policy_of(const Campaign& campaign) {
  return {.task_timeout = std::chrono::duration_cast<Duration>(
              std::chrono::duration<double>(campaign.task_timeout_s)),
          .retries = campaign.retries,
          .stop_on_failure = campaign.stop_on_failure,
          .audit_every = campaign.audit_every};
}

}  // namespace

std::string bind_of(const RunOptions& options) {
  if (options.bind.empty()) return "tcp://127.0.0.1:*";
  // An invalid address is refused when the server listens on it.
  return endpoint_of(options.bind, false).value_or(options.bind);
}

ServiceOptions service_options(const std::vector<const Campaign*>& campaigns,
                               const RunOptions& options) {
  ServiceOptions service;
  SchedulerOptions& scheduler = service.coordinator.scheduler;
  std::vector<WorkerScenario> scenarios;
  scheduler.campaigns.clear();
  for (const Campaign* campaign : campaigns) {
    scenarios.push_back(scenario_of(*campaign));
    scheduler.campaigns.push_back(policy_of(*campaign));
  }
  service.coordinator.scenario = to_bytes(scenarios);
  scheduler.engine_version = kEngineVersion;
  scheduler.self_test = self_test_digest();
  scheduler.evaluates_programs = campaigns.front()->target.has_value();
  if (!scheduler.evaluates_programs) {
    service.make_referee = [](const std::string& scenario, std::function<void()> on_ruling) {
      return make_process_referee({.scenario = scenario,
                                   .engine_version = kEngineVersion,
                                   .self_test = self_test_digest(),
                                   .on_ruling = std::move(on_ruling)});
    };
  }
  service.coordinator.local_secret = random_secret();
  service.bind = bind_of(options);
  return service;
}

LaunchOptions launch_of(const Campaign& campaign, const RunOptions& options) {
  LaunchOptions launch = options.launch.value_or(campaign.launch);
  if (options.launch) return launch;
  if (options.workers) launch.kind = LaunchOptions::Kind::Local;
  const std::optional<std::int64_t> named =
      options.workers ? options.workers : campaign.local_workers;
  launch.processes = named.value_or(1);
  launch.slots = named.value_or(0);
  return launch;
}

Expected<void> check_agreement(const std::vector<Campaign>& campaigns, const RunOptions& options) {
  for (const Campaign& campaign : campaigns) {
    const bool said = options.workers || options.launch;
    const bool alike = campaign.local_workers == campaigns.front().local_workers &&
                       campaign.launch == campaigns.front().launch;
    if (!said && !alike) {
      return bad_input(
          "the campaigns ask for different workers: choose with --workers which ones they share",
          campaign.name);
    }
    if (options.bind.empty() && campaign.bind != campaigns.front().bind) {
      return bad_input("the campaigns listen on different addresses: give them the same `bind`",
                       campaign.name);
    }
  }
  return {};
}

Expected<std::unique_ptr<Service>> open_service(ServiceOptions options,
                                                const std::vector<ServiceCampaign>& campaigns,
                                                bool next_port) {
  constexpr int kPorts = 100;
  const std::string bind = options.bind;
  for (int next = 1;; ++next) {
    auto service = Service::open(options, campaigns);
    const bool taken = !service && service.error().kind == ErrorKind::Conflict;
    if (!taken || !next_port || next == kPorts) return service;
    auto address = address_of(bind);
    address->port += next;
    options.bind = tcp_endpoint(*address);
  }
}

Expected<std::unique_ptr<HttpServer>> open_pages(const RunOptions& options,
                                                 std::shared_ptr<HttpSite> site,
                                                 const std::string& act_token) {
  if (options.http.empty()) return std::unique_ptr<HttpServer>();
  auto address = parse_address(options.http);
  if (!address) return Unexpected(address.error());
  HttpOptions http{.address = *address,
                   .next_port = options.http_next_port,
                   .token = {},
                   .names = options.http_names,
                   .site = std::move(site),
                   .act_token = act_token};
  if (!options.http_token_file.empty()) {
    auto token = read_token(options.http_token_file);
    if (!token) return Unexpected(token.error());
    http.token = *token;
  }
  return HttpServer::start(std::move(http));
}

}  // namespace swarmsmith::cli
