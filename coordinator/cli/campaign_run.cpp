#include "coordinator/cli/campaign_run.h"

#include <unistd.h>
#include <algorithm>
#include <csignal>
#include <memory>
#include <set>
#include <stop_token>
#include <utility>

#include "access/address.h"
#include "access/key_file.h"
#include "base/descriptor_limit.h"
#include "coordinator/campaign/campaign_rows.h"
#include "coordinator/campaign/programs.h"
#include "coordinator/cli/campaign_result.h"
#include "coordinator/cli/progress.h"
#include "coordinator/cli/store_argument.h"
#include "coordinator/design/campaign_runner.h"
#include "coordinator/design/plans.h"
#include "coordinator/http/http_server.h"
#include "coordinator/launchers/start_workers.h"
#include "coordinator/launchers/worker_program.h"
#include "coordinator/paused_designs.h"
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

CampaignPolicy policy_of(const Campaign& campaign) {
  return {.task_timeout = std::chrono::duration_cast<Duration>(
              std::chrono::duration<double>(campaign.task_timeout_s)),
          .retries = campaign.retries,
          .stop_on_failure = campaign.stop_on_failure,
          .audit_every = campaign.audit_every};
}

/// The campaigns agree about everything but their scenarios and policies (`check_agreement`).
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
  service.bind = bind_of(options);
  return service;
}

/// Who starts workers: `--workers`, or the file.
LaunchOptions launch_of(const Campaign& campaign, const RunOptions& options) {
  LaunchOptions launch = options.launch.value_or(campaign.launch);
  if (options.launch) return launch;
  if (options.workers) launch.kind = LaunchOptions::Kind::Local;
  launch.processes = options.workers.value_or(campaign.local_workers.value_or(1));
  return launch;
}

/// Workers and the address are of the pool: files that say different things are of no help.
Expected<void> check_agreement(const std::vector<Campaign>& campaigns, const RunOptions& options) {
  for (const Campaign& campaign : campaigns) {
    const bool said = options.workers || options.launch;
    const bool alike = campaign.local_workers == campaigns.front().local_workers &&
                       campaign.launch == campaigns.front().launch;
    if (!said && !alike) {
      return bad_input("the campaigns ask for different workers: say by --workers which they share",
                       campaign.name);
    }
    if (options.bind.empty() && campaign.bind != campaigns.front().bind) {
      return bad_input("the campaigns listen on different addresses: give them the same `bind`",
                       campaign.name);
    }
  }
  return {};
}

/// The campaign's name, or, where others have the same, its store.
std::string name_among(const std::vector<Campaign>& campaigns, const Campaign& campaign) {
  const bool is_alone = std::ranges::count(campaigns, campaign.name, &Campaign::name) == 1;
  return is_alone ? campaign.name : campaign.store.string();
}

/// How much worse than others an end is: a campaign that cannot go on outweighs one that can.
int gravity(ExitCode code) {
  if (code == ExitCode::Done) return 0;
  if (code == ExitCode::Interrupted || code == ExitCode::Terminated) return 1;
  if (code == ExitCode::Unreachable) return 2;
  if (code == ExitCode::OverFailureLimit) return 3;
  return 4;
}

/// Campaigns that are being run: everything that must live while the service does.
class CampaignRun {
 public:
  CampaignRun(Output& output, const std::vector<Campaign>& campaigns, const RunOptions& options,
              RunListener& listener)
      : output_(output), options_(options), listener_(listener) {
    for (const Campaign& campaign : campaigns)
      members_.push_back({.campaign = &campaign, .name = name_among(campaigns, campaign)});
    if (options_.bind.empty()) options_.bind = campaigns.front().bind;
    // Workers from other hosts have to reach it; where it is, its file says.
    const bool local = launch_of(campaigns.front(), options_).kind == LaunchOptions::Kind::Local;
    if (options_.bind.empty() && !local) options_.bind = "0.0.0.0:0";
  }

  std::vector<ExitCode> run() {
    ExitCode begun = open_stores();
    if (begun == ExitCode::Done && !running_.empty()) begun = begin();
    std::vector<ExitCode> ends;
    for (const Member& member : members_)
      ends.push_back(begun == ExitCode::Done ? member.end : begun);
    return ends;
  }

 private:
  struct Member {
    const Campaign* campaign;
    std::string name;                ///< that no other has
    std::unique_ptr<Store> store{};  ///< closed when the campaign was finished before
    std::unique_ptr<CampaignRunner> runner{};
    ExitCode end = ExitCode::Done;
  };

  ExitCode open_stores() {
    for (std::size_t i = 0; i < members_.size(); ++i) {
      const Campaign& campaign = *members_[i].campaign;
      StoreOptions options;
      // A run of a program may have cost minutes: it waits for nobody.
      if (campaign.target) options.gather = std::chrono::milliseconds(0);
      auto store =
          Store::open(campaign.store, campaign_row(campaign), design_rows(campaign), options);
      if (!store) return fail(output_, exit_code_of_store(store.error()), store.error());
      for (const DesignStateRow& state : (*store)->design_states())
        listener_.restore(i, state);
      const std::vector<CommandRow> commands = (*store)->commands();
      for (const CommandRow& command : commands)
        listener_.restore(i, command);
      if ((*store)->finished() && !waits_for_extension(commands)) continue;
      members_[i].store = std::move(*store);
      running_.push_back(i);
    }
    return ExitCode::Done;
  }

  ExitCode begin() {
    bool well = true;
    for (const std::size_t i : running_) {
      for (const Error& fault : check_programs(*members_[i].campaign)) {
        print_error(output_, fault);
        well = false;
      }
    }
    if (!well) return ExitCode::Usage;
    catch_signals();
    for (const std::size_t i : running_) {
      auto plans = plans_of(*members_[i].campaign);
      if (!plans) return fail(output_, ExitCode::Usage, plans.error());
      replay(members_[i], std::move(*plans));
      if (const auto error = members_[i].runner->error()) return fail_of(members_[i], *error);
    }
    if (!open_door()) return ExitCode::Usage;
    auto service = listen();
    if (!service) return fail(output_, exit_code_of(service.error()), service.error());
    const std::string endpoint = (*service)->endpoint();
    if (auto served = serve_pages(); !served) {
      return fail(output_, exit_code_of(served.error()), served.error());
    }
    CoordinatorFile file = coordinator_file(options_.access, access_, endpoint);
    if (pages_) file.http = "http://" + pages_->address();
    for (const std::filesystem::path& path : coordinator_paths()) {
      if (const auto written = write_coordinator_file(path, file); !written) {
        return fail(output_, ExitCode::Unreachable, written.error());
      }
    }
    if (options_.announce) announce(endpoint);
    const ExitCode ended = serve_with_workers(**service);
    for (const std::filesystem::path& path : coordinator_paths())
      remove_coordinator_file(path, file);
    return ended;
  }

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

  /// Beside each store, so that whoever knows one of them finds the coordinator.
  std::vector<std::filesystem::path> coordinator_paths() const {
    if (!options_.access.coordinator_file.empty()) return {options_.access.coordinator_file};
    std::vector<std::filesystem::path> paths;
    for (const std::size_t i : running_)
      paths.push_back(coordinator_file_of(members_[i].campaign->store));
    return paths;
  }

  /// Workers of this host get the address, others the file in which it stands.
  WorkersSetup workers_setup(const std::string& endpoint) const {
    const Campaign& first = *members_[running_.front()].campaign;
    WorkersSetup setup{.launch = launch_of(first, options_),
                       .local_slots = static_cast<int>(options_.slots),
                       .campaign_digest = campaign_digest(first),
                       .store = first.store};
    const auto file = std::filesystem::absolute(coordinator_paths().front());
    setup.shared_folder = file.parent_path();
    setup.address.endpoint = local_endpoint(endpoint);
    if (setup.launch.kind != LaunchOptions::Kind::Local) setup.address.coordinator = file;
    if (access_.keys) setup.address.key = std::filesystem::absolute(access_.local_key);
    setup.arguments = allow_all();
    if (access_.insecure_plaintext) setup.arguments.emplace_back("--insecure-plaintext");
    return setup;
  }

  ExitCode serve_with_workers(Service& service) {
    const WorkersSetup setup = workers_setup(service.endpoint());
    if (!setup.address.key.empty() && setup.wants_workers()) {
      if (const auto key = read_client_key(access_.local_key); !key) {
        return fail(output_, ExitCode::Usage, key.error());
      }
    }
    const auto workers = start_workers(setup);
    if (workers) return serve(service, workers->get());
    for (const Error& error : workers.error())
      print_error(output_, error);
    const bool usage = workers.error().front().kind == ErrorKind::BadInput;
    return usage ? ExitCode::Usage : ExitCode::Unreachable;
  }

  /// What lets workers run the programs of any of the campaigns.
  std::vector<std::string> allow_all() const {
    std::vector<std::string> arguments;
    for (const std::size_t i : running_) {
      if (!members_[i].campaign->target) continue;
      for (std::string& argument : allow_arguments(*members_[i].campaign->target))
        arguments.push_back(std::move(argument));
    }
    return arguments;
  }

  /// On the address that was asked for, or on one of the next ports where that will do.
  Expected<std::unique_ptr<Service>> listen() {
    constexpr int kPorts = 100;
    std::vector<const Campaign*> campaigns;
    std::vector<ServiceCampaign> served;
    std::int64_t first_worker = 1;
    for (const std::size_t i : running_) {
      const Member& member = members_[i];
      campaigns.push_back(member.campaign);
      served.push_back({campaign_digest(*member.campaign), member.store.get(), member.runner.get(),
                        member.name, design_rows(*member.campaign), member.campaign->store});
      first_worker = std::max(first_worker, member.store->next_worker());
    }
    ServiceOptions service_for = service_options(campaigns, options_);
    service_for.coordinator.scheduler.first_worker = first_worker;
    service_for.keys = access_.keys;
    service_for.insecure_plaintext = access_.insecure_plaintext;
    if (access_.watch) {
      service_for.new_clients = [watch = access_.watch] { return watch->take(); };
    }
    const std::string bind = service_for.bind;
    for (int next = 1;; ++next) {
      auto service = Service::open(service_for, served);
      const bool taken = !service && service.error().kind == ErrorKind::Conflict;
      if (!taken || !options_.next_port || next == kPorts) return service;
      const std::size_t colon = bind.rfind(':') + 1;
      service_for.bind =
          bind.substr(0, colon) + std::to_string(std::stoi(bind.substr(colon)) + next);
    }
  }

  /// Of all campaigns, over HTTP, where that was asked for.
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

  void replay(Member& member, std::vector<DesignPlan> plans) {
    Store& store = *member.store;
    const std::string file = member.campaign->store.string();
    const std::vector<CommandRow> commands = store.commands();
    const std::vector<DesignId> ended = ended_designs(store.design_states(), commands);
    const auto scores = store.scores();
    if (!scores.empty()) {
      print_note(output_, "going on with " + std::to_string(scores.size()) +
                              " evaluations that are in " + file);
    }
    member.runner = std::make_unique<CampaignRunner>(
        std::move(plans), by_design(scores, store.steps(), ended), ended, commands);
    std::vector<DesignId> paused = member.runner->unfinished();
    const std::set<DesignId> all_paused = paused_designs(commands);
    std::erase_if(paused, [&](DesignId design) { return !all_paused.contains(design); });
    if (paused.empty()) return;
    print_note(output_, listed(paused) + " paused: `swarmsmith resume " + file + " " +
                            to_string(paused.front()) + "` lets go on");
  }

  ExitCode serve(Service& service, Launcher* workers) {
    std::stop_source stop;
    std::string worker_trouble;
    const ServiceHooks hooks{
        .on_rows =
            [&](std::optional<std::size_t> campaign, std::span<const Row> rows) {
              if (campaign) campaign = running_[*campaign];
              for (const Row& row : rows)
                listener_.add(campaign, row, clock_.now());
            },
        .on_status =
            [&](LiveStatus& live) {
              if (g_read_clients != 0 && access_.watch) {
                g_read_clients = 0;
                access_.watch->look_now();
              }
              if (workers != nullptr && worker_trouble.empty()) {
                worker_trouble = workers->tend(clock_.now());
                if (worker_trouble.empty()) live.launcher = workers->status();
              }
              last_ = live;
              if (pages_) pages_->publish(live);
              listener_.update(last_, clock_.now());
              if (g_signal != 0 || !worker_trouble.empty()) stop.request_stop();
            },
    };
    const ServiceEnd end = service.run(stop.get_token(), hooks);
    const std::string left_behind =
        workers == nullptr ? "" : workers->stop(std::chrono::seconds(2));
    listener_.finish(last_);
    if (!left_behind.empty()) print_note(output_, left_behind);
    for (std::size_t i = 0; i < running_.size(); ++i) {
      Member& member = members_[running_[i]];
      member.end = end_of(member, end.reasons[i], worker_trouble);
    }
    if (!worker_trouble.empty()) fail(output_, ExitCode::Unreachable, worker_trouble);
    return ExitCode::Done;
  }

  /// How a campaign ended, after having said it where it is not well.
  ExitCode end_of(const Member& member, const std::string& reason, const std::string& trouble) {
    if (const auto error = member.runner->error()) return fail_of(member, *error);
    if (!reason.empty()) {
      print_resume(member);
      return fail(output_, ExitCode::OverFailureLimit, in_front(member, ": ") + reason);
    }
    if (member.store->finished()) return ExitCode::Done;
    if (!trouble.empty()) return ExitCode::Unreachable;
    print_resume(member);
    return g_signal == SIGTERM ? ExitCode::Terminated : ExitCode::Interrupted;
  }

  static ExitCode exit_code_of(const Error& error) {
    return error.kind == ErrorKind::BadInput ? ExitCode::Usage : ExitCode::Unreachable;
  }

  ExitCode fail_of(const Member& member, Error error) {
    error.message.insert(0, in_front(member, ": "));
    return fail(output_, error.kind == ErrorKind::Corrupt ? ExitCode::Store : ExitCode::Failed,
                error);
  }

  /// The campaign's name, when there are several.
  std::string in_front(const Member& member, const std::string& mark) const {
    return members_.size() > 1 ? member.campaign->name + mark : "";
  }

  void announce(const std::string& endpoint) {
    const std::string advertised = advertised_endpoint(endpoint, options_.access.advertise);
    const std::string address = advertised.substr(advertised.find("//") + 2);
    print_note(output_, "waiting for workers: swarmsmith worker --connect " + address +
                            (access_.keys ? " --key " + access_.local_key.string() : "") +
                            (access_.insecure_plaintext ? " --insecure-plaintext" : ""));
  }

  void print_resume(const Member& member) {
    if (!options_.keeps_store) return;
    print_note(output_, "everything so far is in " + member.campaign->store.string() +
                            "; the same command goes on from there");
  }

  Output& output_;
  RunOptions options_;
  RunListener& listener_;
  std::vector<Member> members_;
  std::vector<std::size_t> running_;  ///< of `members_`, in the order of the service
  SystemClock clock_;
  LiveStatus last_;
  std::unique_ptr<HttpServer> pages_;
  Access access_;
};

/// Lines of several campaigns begin with their names.
std::vector<ToldCampaign> told(const std::vector<Campaign>& campaigns) {
  std::vector<ToldCampaign> told;
  for (const Campaign& campaign : campaigns) {
    told.push_back(
        {campaigns.size() > 1 ? name_among(campaigns, campaign) : "", design_rows(campaign)});
  }
  return told;
}

ExitCode show_result(Output& output, const Campaign& campaign, const std::string& name) {
  const auto reader = StoreReader::open(campaign.store);
  if (!reader) return fail(output, exit_code_of_store(reader.error()), reader.error());
  const ExitCode written = write_result(output, **reader, name);
  if (!output.json) print_next_steps(output, campaign.store.string());
  return written;
}

}  // namespace

std::vector<ExitCode> carry_out(Output& output, const std::vector<Campaign>& campaigns,
                                const RunOptions& options, RunListener& listener) {
  return CampaignRun(output, campaigns, options, listener).run();
}

ExitCode run_campaigns(Output& output, const std::vector<Campaign>& campaigns,
                       const RunOptions& options) {
  if (const auto agreed = check_agreement(campaigns, options); !agreed) {
    return fail(output, ExitCode::Usage, agreed.error());
  }
  const std::vector<ToldCampaign> names = told(campaigns);
  Progress progress(output, names, SystemClock().now());
  std::vector<ExitCode> ends = carry_out(output, campaigns, options, progress);
  for (std::size_t i = 0; i < campaigns.size(); ++i) {
    if (ends[i] == ExitCode::Done) ends[i] = show_result(output, campaigns[i], names[i].name);
  }
  return *std::ranges::max_element(ends, {}, gravity);
}

}  // namespace swarmsmith::cli
