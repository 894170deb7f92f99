#include "coordinator/cli/campaign_run.h"

#include <unistd.h>
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <stop_token>
#include <utility>

#include "access/address.h"
#include "access/key_file.h"
#include "base/descriptor_limit.h"
#include "coordinator/campaign/campaign_file.h"
#include "coordinator/campaign/campaign_rows.h"
#include "coordinator/campaign/programs.h"
#include "coordinator/cli/campaign_argument.h"
#include "coordinator/cli/campaign_result.h"
#include "coordinator/cli/progress.h"
#include "coordinator/cli/store_argument.h"
#include "coordinator/design/campaign_runner.h"
#include "coordinator/design/plans.h"
#include "coordinator/http/http_server.h"
#include "coordinator/local_workers.h"
#include "coordinator/service.h"
#include "sim/engine/self_test.h"
#include "sim/engine/simulate.h"
#include "sim/messages/scenario_messages.h"

namespace swarmsmith::cli {
namespace {

/// Of the process, besides its connections: stores, logs, workers' pipes.
constexpr int kOtherDescriptors = 1'000;

// Set by the handlers, read by the loop.
volatile std::sig_atomic_t g_signal = 0;
volatile std::sig_atomic_t g_read_clients = 0;

void on_signal(int signal) {
  if (g_signal != 0) _exit(128 + signal);
  g_signal = signal;
}

void catch_signals() {
  struct sigaction action = {};
  action.sa_handler = on_signal;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

void on_hangup(int) {
  g_read_clients = 1;
}

/// Only where there is a list of clients to read again: else a terminal that goes away ends the
/// run, as it ends others.
void catch_hangup() {
  struct sigaction action = {};
  action.sa_handler = on_hangup;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGHUP, &action, nullptr);
}

WorkerScenario scenario_of(const Campaign& campaign) {
  WorkerScenario scenario{.campaign_digest = campaign_digest(campaign),
                          .engine_version = kEngineVersion,
                          .profile = campaign.profile,
                          .target = campaign.target};
  if (campaign.target) {
    for (const CampaignMission& mission : campaign.missions) {
      InstanceTexts& texts = scenario.instances.emplace_back(mission.instances);
      // Without test instances elites are tested on fresh seeds of the training instances.
      if (texts.test.empty() && mission.test_count > 0) texts.test = texts.training;
    }
    return scenario;
  }
  for (const CampaignMission& mission : campaign.missions) {
    scenario.missions.push_back(mission.mission);
  }
  for (const Method& method : campaign.methods)
    scenario.methods.push_back({.flavour = method.flavour, .turn_clock = method.turn_clock});
  return scenario;
}

/// Where the coordinator listens, as tcp://HOST:PORT.
std::string bind_of(const RunOptions& options) {
  if (options.bind.empty()) return "tcp://127.0.0.1:*";
  const bool has_scheme = options.bind.find("://") != std::string::npos;
  return (has_scheme ? "" : "tcp://") + options.bind;
}

ServiceOptions service_options(const Campaign& campaign, const RunOptions& options) {
  ServiceOptions service;
  service.coordinator.scenario = to_bytes({scenario_of(campaign)});
  SchedulerOptions& scheduler = service.coordinator.scheduler;
  scheduler.engine_version = kEngineVersion;
  scheduler.self_test = self_test_digest();
  scheduler.campaigns = {{.task_timeout = std::chrono::duration_cast<Duration>(
                              std::chrono::duration<double>(campaign.task_timeout_s)),
                          .retries = campaign.retries,
                          .stop_on_failure = campaign.stop_on_failure,
                          .audit_every = campaign.audit_every}};
  scheduler.evaluates_programs = campaign.target.has_value();
  service.bind = bind_of(options);
  return service;
}

/// Local worker processes as `--workers` and the file have them: a number of processes, or one with
/// as many slots as there are cores.
int local_processes(const Campaign& campaign, const RunOptions& options) {
  return static_cast<int>(options.workers.value_or(campaign.local_workers.value_or(1)));
}

ExitCode show_result(Output& output, const Campaign& campaign) {
  const auto reader = StoreReader::open(campaign.store);
  if (!reader) return fail(output, exit_code_of_store(reader.error()), reader.error());
  const ExitCode written = write_result(output, **reader);
  if (!output.json) print_next_steps(output, campaign.store.string());
  return written;
}

/// A campaign that is being run: everything that must live while the service does.
class CampaignRun {
 public:
  CampaignRun(Output& output, const Campaign& campaign, const RunOptions& options, Store& store,
              RunListener& listener)
      : output_(output),
        campaign_(campaign),
        options_(options),
        store_(store),
        listener_(listener) {}

  ExitCode run() {
    const std::vector<Error> faults = check_programs(campaign_);
    for (const Error& fault : faults)
      print_error(output_, fault);
    if (!faults.empty()) return ExitCode::Usage;
    catch_signals();
    auto plans = plans_of(campaign_);
    if (!plans) return fail(output_, ExitCode::Usage, plans.error());
    CampaignRunner runner = replay(std::move(*plans));
    if (runner.error()) return fail_of(*runner.error());
    if (!open_door()) return ExitCode::Usage;
    auto service = listen(runner);
    if (!service) return fail(output_, exit_code_of(service.error()), service.error());
    const std::string endpoint = (*service)->endpoint();
    if (auto served = serve_pages(); !served) {
      return fail(output_, exit_code_of(served.error()), served.error());
    }
    CoordinatorFile file = coordinator_file(options_.access, access_, endpoint);
    if (pages_) file.http = "http://" + pages_->address();
    if (const auto written = write_coordinator_file(coordinator_path(), file); !written) {
      return fail(output_, ExitCode::Unreachable, written.error());
    }
    if (options_.announce) announce(endpoint);
    const ExitCode ended = serve_with_workers(**service, runner);
    remove_coordinator_file(coordinator_path(), file);
    return ended;
  }

 private:
  /// Keys and clients, or plaintext; false after having said what is wrong.
  bool open_door() {
    raise_descriptor_limit(SocketOptions().max_connections + kOtherDescriptors);
    auto access = open_access(options_.access, bind_of(options_));
    if (access) {
      access_ = std::move(*access);
      if (access_.watch) catch_hangup();
      return true;
    }
    for (const Error& fault : access.error())
      print_error(output_, fault);
    return false;
  }

  std::filesystem::path coordinator_path() const {
    if (!options_.access.coordinator_file.empty()) return options_.access.coordinator_file;
    return coordinator_file_of(campaign_.store);
  }

  ExitCode serve_with_workers(Service& service, const CampaignRunner& runner) {
    const int processes = local_processes(campaign_, options_);
    if (processes == 0) return serve(service, runner, nullptr);
    std::vector<std::string> arguments;
    if (campaign_.target) arguments = allow_arguments(*campaign_.target);
    if (access_.keys) {
      if (const auto key = read_client_key(access_.local_key); !key) {
        return fail(output_, ExitCode::Usage, key.error());
      }
      arguments.emplace_back("--key");
      arguments.push_back(access_.local_key.string());
    }
    auto workers = LocalWorkers::start({.endpoint = local_endpoint(service.endpoint()),
                                        .processes = processes,
                                        .slots = static_cast<int>(options_.slots),
                                        .arguments = std::move(arguments)});
    if (!workers) return fail(output_, ExitCode::Unreachable, workers.error());
    return serve(service, runner, &*workers);
  }

  /// On the address that was asked for, or on one of the next ports where that will do.
  Expected<std::unique_ptr<Service>> listen(CampaignRunner& runner) {
    constexpr int kPorts = 100;
    ServiceOptions service_for = service_options(campaign_, options_);
    service_for.coordinator.scheduler.first_worker = store_.next_worker();
    service_for.keys = access_.keys;
    service_for.insecure_plaintext = access_.insecure_plaintext;
    if (access_.watch) {
      service_for.new_clients = [watch = access_.watch] { return watch->take(); };
    }
    const std::string bind = service_for.bind;
    for (int next = 1;; ++next) {
      auto service =
          Service::open(service_for, {{campaign_digest(campaign_), &store_, &runner, campaign_.name,
                                       design_rows(campaign_), campaign_.store}});
      const bool taken = !service && service.error().kind == ErrorKind::Conflict;
      if (!taken || !options_.next_port || next == kPorts) return service;
      const std::size_t colon = bind.rfind(':') + 1;
      service_for.bind =
          bind.substr(0, colon) + std::to_string(std::stoi(bind.substr(colon)) + next);
    }
  }

  /// Of this campaign, over HTTP, where that was asked for.
  Expected<void> serve_pages() {
    if (options_.http.empty()) return {};
    auto address = parse_http_address(options_.http);
    if (!address) return Unexpected(address.error());
    HttpOptions http{.address = *address, .next_port = options_.http_next_port, .token = {}};
    if (!options_.http_token_file.empty()) {
      auto token = read_token(options_.http_token_file);
      if (!token) return Unexpected(token.error());
      http.token = *token;
    }
    auto pages = HttpServer::start(std::move(http));
    if (!pages) return Unexpected(pages.error());
    pages_ = std::move(*pages);
    print_note(output_, "metrics, health and status: http://" + pages_->address());
    return {};
  }

  CampaignRunner replay(std::vector<DesignPlan> plans) {
    std::vector<DesignId> finished;
    for (const DesignStateRow& state : store_.design_states()) {
      listener_.restore(state);
      if (state.state == DesignState::Finished) finished.push_back(state.design);
    }
    const auto scores = store_.scores();
    if (!scores.empty()) {
      print_note(output_, "going on with " + std::to_string(scores.size()) +
                              " evaluations that are in " + campaign_.store.string());
    }
    return CampaignRunner(std::move(plans), by_design(scores, store_.steps(), finished), finished);
  }

  ExitCode serve(Service& service, const CampaignRunner& runner, LocalWorkers* workers) {
    std::stop_source stop;
    std::string worker_trouble;
    const ServiceHooks hooks{
        .on_rows =
            [&](std::size_t, const std::vector<Row>& rows) {
              for (const Row& row : rows)
                listener_.add(row, clock_.now());
            },
        .on_status =
            [&](const LiveStatus& live) {
              last_ = live;
              if (pages_) pages_->publish(live);
              if (g_read_clients != 0 && access_.watch) {
                g_read_clients = 0;
                access_.watch->look_now();
              }
              listener_.update(live, clock_.now());
              if (workers != nullptr && worker_trouble.empty()) {
                worker_trouble = workers->tend(clock_.now());
              }
              if (g_signal != 0 || runner.error() || !worker_trouble.empty()) stop.request_stop();
            },
    };
    const ServiceEnd end = service.run(stop.get_token(), hooks);
    if (workers != nullptr) workers->stop(std::chrono::seconds(2));
    listener_.finish(last_);
    if (runner.error()) return fail_of(*runner.error());
    if (!worker_trouble.empty()) return fail(output_, ExitCode::Unreachable, worker_trouble);
    return exit_code_of(end);
  }

  ExitCode exit_code_of(const ServiceEnd& end) {
    switch (end.how) {
      case ServiceEnd::How::Finished:
        return ExitCode::Done;
      case ServiceEnd::How::Stopped:
        print_resume();
        return fail(output_, ExitCode::OverFailureLimit, end.reasons.front());
      case ServiceEnd::How::Interrupted:
        break;
    }
    print_resume();
    return g_signal == SIGTERM ? ExitCode::Terminated : ExitCode::Interrupted;
  }

  static ExitCode exit_code_of(const Error& error) {
    return error.kind == ErrorKind::BadInput ? ExitCode::Usage : ExitCode::Unreachable;
  }

  ExitCode fail_of(const Error& error) {
    return fail(output_, error.kind == ErrorKind::Corrupt ? ExitCode::Store : ExitCode::Failed,
                error);
  }

  void announce(const std::string& endpoint) {
    const std::string advertised = advertised_endpoint(endpoint, options_.access.advertise);
    const std::string address = advertised.substr(advertised.find("//") + 2);
    print_note(output_, "waiting for workers: swarmsmith worker --connect " + address +
                            (access_.keys ? " --key " + access_.local_key.string() : "") +
                            (access_.insecure_plaintext ? " --insecure-plaintext" : ""));
  }

  void print_resume() {
    if (!options_.keeps_store) return;
    print_note(output_, "everything so far is in " + campaign_.store.string() +
                            "; the same command goes on from there");
  }

  Output& output_;
  const Campaign& campaign_;
  const RunOptions& options_;
  Store& store_;
  SystemClock clock_;
  RunListener& listener_;
  LiveStatus last_;
  std::unique_ptr<HttpServer> pages_;
  Access access_;
};

}  // namespace

void CampaignFlags::declare(Options& options, Options::Need file_needed) {
  options.text("FILE", file, "Campaign file", file_needed);
  options.integer("--budget", budget, {1, kLargestBudget}, "Experiments of each design");
  options.integer("--seed", seed, {0, INT64_MAX}, "Seed that everything derives from");
  options.text("--store", store, "Where the results go");
}

std::optional<Campaign> CampaignFlags::read(Output& output) const {
  std::optional<Campaign> campaign =
      file.empty() ? demo_campaign() : read_or_complain(file, output, budget);
  if (!campaign) return std::nullopt;
  if (budget) campaign->race.max_experiments = *budget;
  if (seed) campaign->seed = static_cast<std::uint64_t>(*seed);
  if (const char* variable = std::getenv("SWARMSMITH_STORE");
      variable != nullptr && *variable != '\0') {
    campaign->store = variable;
  }
  if (!store.empty()) campaign->store = store;
  if (!budget) return campaign;
  const std::vector<Error> complaints = check_budget(*campaign);
  for (const Error& complaint : complaints) {
    print_error(output, {complaint.kind, complaint.message, "--budget"});
  }
  if (!complaints.empty()) return std::nullopt;
  return campaign;
}

void HttpFlags::declare(Options& options, const std::string& otherwise) {
  options.text("--http", http,
               "Address and port of /metrics, /healthz, /readyz, /status (" + otherwise + ")");
  options.text("--http-token-file", token_file, "Secret that their readers must show");
}

void HttpFlags::put(RunOptions& run, const std::string& otherwise) const {
  run.http = http == "none" ? "" : http.empty() ? otherwise : http;
  run.http_next_port = http.empty();
  run.http_token_file = token_file;
}

ExitCode carry_out(Output& output, const Campaign& campaign, const RunOptions& options,
                   RunListener& listener) {
  StoreOptions store_options;
  // A run of a program may have cost minutes: it waits for nobody.
  if (campaign.target) store_options.gather = std::chrono::milliseconds(0);
  auto store =
      Store::open(campaign.store, campaign_row(campaign), design_rows(campaign), store_options);
  if (!store) return fail(output, exit_code_of_store(store.error()), store.error());
  if ((*store)->finished()) return ExitCode::Done;
  return CampaignRun(output, campaign, options, **store, listener).run();
}

ExitCode run_campaign(Output& output, const Campaign& campaign, const RunOptions& options) {
  const std::vector<DesignRow> designs = design_rows(campaign);
  Progress progress(output, designs, SystemClock().now());
  const ExitCode ended = carry_out(output, campaign, options, progress);
  return ended == ExitCode::Done ? show_result(output, campaign) : ended;
}

}  // namespace swarmsmith::cli
