#include "cli/run/campaign_flags.h"

#include <malloc.h>
#include <filesystem>
#include <set>

#include "coordinator/campaign/campaign_file.h"
#include "coordinator/campaign/campaign_rows.h"
#include "coordinator/pool/task_key.h"

namespace swarmsmith::cli {
namespace {

/// The canonical path, the same for all names of a file.
std::filesystem::path place_of(const std::filesystem::path& store) {
  std::error_code trouble;
  const auto place = std::filesystem::weakly_canonical(store, trouble);
  return trouble ? store : place;
}

Expected<void> check_one_store(const std::string& store, const std::string& where) {
  if (store.empty()) return {};
  return bad_input(
      "names one store, but each campaign needs its own: name it in its file (key `store`)", where);
}

/// Makes freed blocks of the size of pictures and scenarios return to the system. After the first
/// such block, glibc would take them from the heap, which keeps their gaps. All threads share one
/// heap, because rows are made by one thread and freed by another, and each heap has its own gaps
/// (docs/performance.md).
void give_large_blocks_back() {
  constexpr int kLarge = 512 << 10;
  mallopt(M_MMAP_THRESHOLD, kLarge);
  mallopt(M_ARENA_MAX, 1);
}

}  // namespace

std::optional<Campaign> read_or_complain(const std::string& file, Output& output,
                                         std::optional<std::int64_t> budget) {
  auto campaign = read_campaign(file, budget);
  if (campaign) return std::move(*campaign);
  for (const Error& error : campaign.error())
    print_error(output, error);
  return std::nullopt;
}

void CampaignFlags::declare(Options& options, Options::Need files_needed) {
  options.words("FILE", files,
                "Campaign file; several campaigns share the workers, each with its own store",
                files_needed);
  options.integer("--budget", budget, {1, kLargestBudget}, "Experiments of each design");
  options.integer("--seed", seed, {0, INT64_MAX}, "Seed of all random numbers");
  options.text("--store STORE", store, "The store, which keeps the results");
}

Expected<void> check_pool(const std::vector<Campaign>& campaigns) {
  if (campaigns.size() > kMaxCampaigns) {
    return bad_input("one coordinator runs at most " + std::to_string(kMaxCampaigns) +
                     " campaigns, and these are " + std::to_string(campaigns.size()));
  }
  std::set<std::filesystem::path> stores;
  std::set<std::string> digests;
  for (const Campaign& campaign : campaigns) {
    // The second copy would only compute the same result again.
    if (!digests.insert(campaign_digest(campaign)).second) {
      return bad_input("the campaign is given twice: its answer would be the same", campaign.name);
    }
    if (!stores.insert(place_of(campaign.store)).second) {
      return bad_input("two of the campaigns have this store: give each its own (key `store`)",
                       campaign.store.string());
    }
    if (campaign.target.has_value() != campaigns.front().target.has_value()) {
      return bad_input(
          "some of the campaigns run programs and others the simulator, which have different "
          "rules: run them separately");
    }
  }
  return {};
}

std::optional<std::vector<Campaign>> CampaignFlags::read(Output& output) const {
  give_large_blocks_back();
  const std::string environment = store_of_environment();
  if (files.size() > 1) {
    for (const auto& one :
         {check_one_store(store, "--store"), check_one_store(environment, "SWARMSMITH_STORE")}) {
      if (one) continue;
      print_error(output, one.error());
      return std::nullopt;
    }
  }
  std::vector<Campaign> campaigns;
  bool well = true;
  for (const std::string& file : files.empty() ? std::vector<std::string>{""} : files) {
    std::optional<Campaign> campaign =
        file.empty() ? demo_campaign() : read_or_complain(file, output, budget);
    if (!campaign) {
      well = false;
      continue;
    }
    if (budget) campaign->race.max_experiments = *budget;
    if (seed) campaign->seed = static_cast<std::uint64_t>(*seed);
    if (!environment.empty()) campaign->store = environment;
    if (!store.empty()) campaign->store = store;
    if (budget) {
      for (const Error& complaint : check_budget(*campaign)) {
        print_error(output, {complaint.kind, complaint.message, "--budget"});
        well = false;
      }
    }
    campaigns.push_back(std::move(*campaign));
  }
  if (!well) return std::nullopt;
  if (const auto checked = check_pool(campaigns); !checked) {
    print_error(output, checked.error());
    return std::nullopt;
  }
  return campaigns;
}

void HttpFlags::declare(Options& options, const std::string& without_dashboard) {
  options.text(
      "--http HOST:PORT", http,
      "Address and port of the dashboard, /metrics, /healthz, /readyz and /status (default "
      "127.0.0.1:8347, or the next port that is free; `none`: no pages)");
  options.text("--http-token-file FILE", token_file,
               "File of the secret that their readers must show");
  options.texts("--http-name HOST", names,
                "Name of this host in addresses of the pages, such as a proxy's");
  options.flag("--no-dashboard", no_dashboard, "No dashboard; " + without_dashboard);
}

void HttpFlags::put(RunOptions& run, const std::vector<Campaign>& campaigns) const {
  constexpr const char* kUsual = "127.0.0.1:8347";
  const std::string& of_file = campaigns.front().dashboard_bind;
  run.dashboard = http != "none" && !no_dashboard;
  if (http == "none") {
    run.http.clear();
  } else if (!http.empty()) {
    run.http = http;
  } else {
    run.http = of_file.empty() ? kUsual : of_file;
  }
  run.http_next_port = http.empty() && of_file.empty();
  run.http_token_file = token_file;
  run.http_names = names;
}

}  // namespace swarmsmith::cli
