#include "cli/run/campaign_run.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <set>
#include <stop_token>
#include <thread>
#include <utility>

#include "base/process_limits.h"
#include "cli/arguments/program_name.h"
#include "cli/arguments/store_argument.h"
#include "cli/output/progress.h"
#include "cli/run/campaign_members.h"
#include "cli/run/campaign_result.h"
#include "cli/run/dashboard_setup.h"
#include "cli/run/pool_setup.h"
#include "cli/run/run_signals.h"
#include "coordinator/campaign/campaign_rows.h"
#include "coordinator/launchers/start_workers.h"
#include "proto/access/address.h"
#include "proto/access/key_file.h"

namespace swarmsmith::cli {
namespace {

// Descriptors of the process besides connections: stores, logs, workers' pipes, pages.
constexpr std::int64_t kOtherDescriptors = 1'000;
constexpr std::int64_t kLeastDescriptors = 48;
// Measured: libraries, stacks of threads, and a small campaign. The first number is address space,
// the second is memory in use.
constexpr std::uint64_t kAddressSpace = std::uint64_t{400} << 20U;
constexpr std::uint64_t kMemory = std::uint64_t{48} << 20U;
constexpr std::uint64_t kMemoryOfWorker = std::uint64_t{16} << 20U;

/// Ranks exit codes from best to worst: a campaign that cannot continue is worse than one that can.
int gravity(ExitCode code) {
  if (code == ExitCode::Done) return 0;
  if (code == ExitCode::Interrupted || code == ExitCode::Terminated) return 1;
  if (code == ExitCode::Unreachable) return 2;
  if (code == ExitCode::OverFailureLimit) return 3;
  return 4;
}

ExitCode exit_code_of(const Error& error) {
  return error.kind == ErrorKind::BadInput ? ExitCode::Usage : ExitCode::Unreachable;
}

/// Running campaigns, with all objects that must exist as long as the service.
class CampaignRun {
 public:
  CampaignRun(Output& output, const std::vector<Campaign>& campaigns, const RunOptions& options,
              RunListener& listener)
      : output_(output),
        options_(options),
        listener_(listener),
        members_(output, campaigns, options.keeps_store) {
    if (options_.bind.empty()) options_.bind = campaigns.front().bind;
    // Workers on other hosts must be able to connect; they find the address in the coordinator's
    // file.
    const bool local = launch_of(campaigns.front(), options_).kind == LaunchOptions::Kind::Local;
    if (options_.bind.empty() && !local) options_.bind = "*:0";
  }

  std::vector<ExitCode> run() {
    ExitCode begun = check_limits();
    if (begun == ExitCode::Done) begun = members_.open_stores(listener_);
    if (begun == ExitCode::Done && !members_.running().empty()) begun = begin();
    std::vector<ExitCode> ends;
    for (std::size_t i = 0; i < members_.size(); ++i)
      ends.push_back(begun == ExitCode::Done ? members_.end_of(i) : begun);
    return ends;
  }

 private:
  /// Checked before a store is created, so that no empty store is left behind.
  ExitCode check_limits() {
    const LaunchOptions launch = launch_of(members_.campaign(0), options_);
    const std::int64_t workers = launch.kind == LaunchOptions::Kind::Local ? launch.processes : 0;
    const std::string who = "a campaign with " + std::to_string(workers) +
                            (workers == 1 ? " worker process" : " worker processes") +
                            " of this host";
    auto enough = provide_descriptors(kLeastDescriptors + 2 * workers,
                                      SocketOptions().max_connections + kOtherDescriptors, who);
    if (enough) {
      enough = check_memory(kAddressSpace,
                            kMemory + static_cast<std::uint64_t>(workers) * kMemoryOfWorker, who);
    }
    return enough ? ExitCode::Done : fail(output_, ExitCode::Failed, enough.error());
  }

  ExitCode begin() {
    catch_ending_signals();
    if (const ExitCode begun = members_.begin(); begun != ExitCode::Done) return begun;
    if (!open_door()) return ExitCode::Usage;
    auto service = listen();
    if (!service) return fail(output_, exit_code_of(service.error()), service.error());
    // Before the coordinator's file is written, because it contains the address of the pages.
    if (const auto opened = show_pages(); !opened)
      return fail(output_, exit_code_of(opened.error()), opened.error());
    const std::string endpoint = (*service)->endpoint();
    CoordinatorFile file = coordinator_file(options_.access, access_, endpoint);
    if (pages_) file.http = "http://" + pages_->address();
    const ExitCode ended = serve_at(file, **service);
    // Also if only some could be written: no file may name a coordinator that has ended.
    for (const std::filesystem::path& path : coordinator_files())
      remove_coordinator_file(path, file);
    return ended;
  }

  ExitCode serve_at(const CoordinatorFile& file, Service& service) {
    for (const std::filesystem::path& path : coordinator_files()) {
      if (const auto written = write_coordinator_file(path, file); !written)
        return fail(output_, ExitCode::Unreachable, written.error());
    }
    if (options_.announce) announce(service.endpoint());
    return serve_with_workers(service);
  }

  /// The dashboard of all campaigns that run here.
  void make_dashboard() {
    if (!options_.dashboard || options_.http.empty()) return;
    DashboardOptions dashboard;
    for (std::size_t place = 0; place < members_.size(); ++place) {
      const auto& running = members_.running();
      const auto found = std::ranges::find(running, place);
      std::optional<std::size_t> served;
      if (found != running.end()) served = static_cast<std::size_t>(found - running.begin());
      dashboard.stores.push_back(
          {std::filesystem::absolute(members_.campaign(place).store), served, served.has_value()});
    }
    dashboard.version = program_name();
    dashboard.before_live = [asked = asked_] { asked->store(std::chrono::steady_clock::now()); };
    CoordinatorArgument coordinator;
    if (!options_.access.coordinator_file.empty())
      coordinator.coordinator = options_.access.coordinator_file;
    if (access_.keys) {
      const auto key = access_.local_key.parent_path() / "operator.key";
      std::error_code none;
      if (std::filesystem::exists(key, none)) coordinator.key = key.string();
    }
    coordinator.insecure_plaintext = access_.insecure_plaintext;
    dashboard_ =
        DashboardSetup::make(std::move(dashboard), coordinator,
                             options_.http_token_file.empty() ? DashboardSetup::Secret::New
                                                              : DashboardSetup::Secret::OfOnesOwn);
  }

  /// If only the default address fails, the campaign continues without pages, because the user did
  /// not ask for them.
  Expected<void> show_pages() {
    make_dashboard();
    auto pages = dashboard_ ? open_pages(options_, dashboard_->site(), dashboard_->token())
                            : open_pages(options_, nullptr, "");
    if (!pages && !options_.http_next_port) return Unexpected(pages.error());
    if (!pages) {
      print_note(output_, "no dashboard: " + to_string(pages.error()));
      dashboard_.reset();
      return {};
    }
    pages_ = std::move(*pages);
    if (!pages_) return {};
    if (dashboard_) {
      dashboard_->announce(output_, pages_->address());
    } else {
      print_note(output_, "metrics, health and status: http://" + pages_->address());
    }
    return {};
  }

  /// Reads keys and clients, or allows plaintext; false after printing the errors.
  bool open_door() {
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

  std::vector<std::filesystem::path> coordinator_files() const {
    if (!options_.access.coordinator_file.empty()) return {options_.access.coordinator_file};
    return members_.coordinator_files();
  }

  Expected<std::unique_ptr<Service>> listen() {
    ServiceOptions service = service_options(members_.campaigns(), options_);
    service.coordinator.scheduler.first_worker = members_.first_worker();
    local_secret_ = service.coordinator.local_secret;
    service.keys = access_.keys;
    service.insecure_plaintext = access_.insecure_plaintext;
    if (access_.watch) {
      service.new_clients = [watch = access_.watch] { return watch->take(); };
    }
    return open_service(std::move(service), members_.served(), options_.next_port);
  }

  /// Workers on this host get the address, other workers get the file that contains it.
  WorkersSetup workers_setup(const std::string& endpoint) const {
    const Campaign& first = members_.campaign(members_.running().front());
    WorkersSetup setup{.launch = launch_of(first, options_),
                       .local_slots = static_cast<int>(options_.slots),
                       .local_secret = local_secret_,
                       .campaign_digest = campaign_digest(first),
                       .store = first.store};
    const auto file = std::filesystem::absolute(coordinator_files().front());
    setup.shared_folder = file.parent_path();
    setup.address.endpoint = local_endpoint(endpoint);
    if (setup.launch.kind != LaunchOptions::Kind::Local) setup.address.coordinator = file;
    if (access_.keys) setup.address.key = std::filesystem::absolute(access_.local_key);
    setup.arguments = members_.allowed_programs();
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

  ExitCode serve(Service& service, Launcher* workers) {
    std::stop_source stop;
    std::string worker_trouble;
    const ServiceHooks hooks{
        .on_rows =
            [&](std::optional<std::size_t> campaign, std::span<const Row> rows) {
              if (campaign) campaign = members_.running()[*campaign];
              for (const Row& row : rows)
                listener_.add(campaign, row, clock_.now());
            },
        .on_status =
            [&](LiveStatus& live) {
              if (access_.watch && take_hangup()) access_.watch->look_now();
              if (workers != nullptr && worker_trouble.empty()) {
                worker_trouble = workers->tend(clock_.now());
                if (worker_trouble.empty()) live.launcher = workers->status();
              }
              explain_quarantine(live);
              last_ = live;
              if (pages_) pages_->publish(live);
              listener_.update(last_, clock_.now());
              if (ending_signal() != 0 || !worker_trouble.empty()) stop.request_stop();
            },
    };
    const ServiceEnd end = service.run(stop.get_token(), hooks);
    let_pages_hear();
    // Readers of the pages would prevent the stores from folding in their logs.
    pages_.reset();
    dashboard_.reset();
    const std::string left_behind =
        workers == nullptr ? "" : workers->stop(std::chrono::seconds(2));
    listener_.finish(last_);
    if (!left_behind.empty()) print_note(output_, left_behind);
    members_.end(end, worker_trouble);
    if (!worker_trouble.empty()) fail(output_, ExitCode::Unreachable, worker_trouble);
    return ExitCode::Done;
  }

  /// An open page asks once a second. Waits until it has seen the end, so that it does not remain
  /// at "97 %".
  void let_pages_hear() const {
    using Clock = std::chrono::steady_clock;
    using std::chrono::milliseconds;
    constexpr milliseconds kLooks{3000};     // a page is open if it has asked within this time
    constexpr milliseconds kOldAnswer{600};  // an older answer may still be sent within this time
    constexpr milliseconds kAtMost{2500};
    const auto end = Clock::now();
    if (!pages_ || !dashboard_ || end - asked_->load() > kLooks) return;
    while (asked_->load() < end + kOldAnswer && Clock::now() < end + kAtMost)
      std::this_thread::sleep_for(milliseconds(20));
    std::this_thread::sleep_for(milliseconds(100));  // time to send the answer
  }

  /// Prints each quarantine once, so that people who wait for workers know which are refused.
  void explain_quarantine(const LiveStatus& live) {
    for (const QuarantineStatus& one : live.quarantine) {
      if (!told_of_quarantine_.emplace(one.who, one.worker).second) continue;
      const std::string store = members_.campaign(members_.running().front()).store.string();
      print_note(output_, quarantine_line(one) + "; `swarmsmith forgive " + store + " \"" +
                              one.who + "\"` lets it work again");
    }
    std::erase_if(told_of_quarantine_, [&](const auto& told) {
      return std::ranges::none_of(live.quarantine, [&](const QuarantineStatus& one) {
        return told == std::pair(one.who, one.worker);
      });
    });
  }

  void announce(const std::string& endpoint) {
    const std::string advertised = advertised_endpoint(endpoint, options_.access.advertise);
    const std::string address = advertised.substr(advertised.find("//") + 2);
    print_note(output_, "waiting for workers: swarmsmith worker --connect " + address +
                            (access_.keys ? " --key " + access_.local_key.string() : "") +
                            (access_.insecure_plaintext ? " --insecure-plaintext" : ""));
  }

  Output& output_;
  RunOptions options_;
  RunListener& listener_;
  CampaignMembers members_;
  SystemClock clock_;
  LiveStatus last_;
  /// When a page asked last.
  std::shared_ptr<std::atomic<std::chrono::steady_clock::time_point>> asked_ =
      std::make_shared<std::atomic<std::chrono::steady_clock::time_point>>();
  std::unique_ptr<DashboardSetup> dashboard_;
  std::unique_ptr<HttpServer> pages_;
  Access access_;
  std::string local_secret_;
  std::set<std::pair<std::string, std::int64_t>> told_of_quarantine_;
};

/// With several campaigns, each line begins with a name.
std::vector<ToldCampaign> told(const std::vector<Campaign>& campaigns) {
  std::vector<ToldCampaign> told;
  told.reserve(campaigns.size());
  for (const Campaign& campaign : campaigns) {
    told.push_back({.name = campaigns.size() > 1 ? name_among(campaigns, campaign) : "",
                    .designs = design_rows(campaign),
                    .costs = campaign.target.has_value(),
                    .searches = searches_of(campaign)});
  }
  return told;
}

ExitCode show_result(Output& output, const Campaign& campaign, const std::string& name) {
  const auto reader = StoreReader::open(campaign.store);
  if (!reader) return fail(output, exit_code_of_store(reader.error()), reader.error());
  const ExitCode written = write_result(output, **reader, name);
  const auto winner =
      select(**reader, "SELECT 1 FROM v_designs WHERE best_candidate IS NOT NULL LIMIT 1");
  if (!output.json) {
    print_next_steps(output, campaign.store.string(), winner && !winner->cells.empty(),
                     campaign.name == "demo");
  }
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
