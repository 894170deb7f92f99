#include "benchmarks/cluster/local_cluster.h"

#include <unistd.h>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>

#include "coordinator/launchers/local_workers.h"
#include "coordinator/service/service.h"

namespace swarmsmith::bench {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("swarmsmith-bench." + std::to_string(getpid()))) {
    fs::create_directories(path_);
  }
  ~Folder() {
    std::error_code failed;
    fs::remove_all(path_, failed);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  fs::path store() const { return path_ / "store.db"; }

 private:
  fs::path path_;
};

Expected<std::unique_ptr<Store>> open_store(const fs::path& path, int designs) {
  CampaignRow campaign;
  campaign.name = "benchmark";
  campaign.digest = "benchmark";
  campaign.deciding = "{}";
  std::vector<DesignRow> rows;
  for (int number = 1; number <= designs; ++number) {
    rows.push_back({.id = {number}, .mission = "m", .method = "m", .repetition = number});
  }
  return Store::open(path, campaign, rows);
}

bool is_worker_row(const Row& row) {
  return std::holds_alternative<WorkerRow>(row);
}

}  // namespace

Expected<ClusterRun> run_cluster(const ClusterShape& shape, WorkSource& source,
                                 const std::function<void(const LiveStatus&)>& on_status,
                                 const std::function<void(std::span<const Row>)>& on_rows) {
  const Folder folder;
  auto store = open_store(folder.store(), shape.designs);
  if (!store) return Unexpected(store.error());
  ServiceOptions options;
  options.coordinator.scenario = to_text(shape.work);
  std::optional<ClientKeys> keys;
  if (shape.curve) {
    const KeyPair server = make_key_pair();
    const KeyPair worker = make_key_pair();
    options.keys = ServerKeys{
        .secret_key = server.secret_key,
        .clients = {{.name = "w", .role = Role::Worker, .public_key = worker.public_key}}};
    keys = ClientKeys{.secret_key = worker.secret_key, .server_key = server.public_key};
  }
  auto service = Service::open(options, {{"benchmark", store->get(), &source}});
  if (!service) return Unexpected(service.error());
  announce((*service)->endpoint(), shape.each, keys);

  ClusterRun run;
  const double children = cpu_of_children();
  const CpuByThread before = cpu_by_thread();
  const auto launched = Clock::now();
  auto local = LocalWorkers::start({.endpoint = (*service)->endpoint(),
                                    .processes = shape.processes,
                                    .slots = shape.each.slots,
                                    .program = "/proc/self/exe",
                                    .arguments = {}});
  if (!local) return Unexpected(local.error());
  std::optional<Clock::time_point> begin;
  const ServiceHooks hooks{.on_rows =
                               [&](std::optional<std::size_t>, std::span<const Row> rows) {
                                 // The first connection adds a row.
                                 if (!begin && std::ranges::any_of(rows, is_worker_row))
                                   begin = Clock::now();
                                 if (on_rows) on_rows(rows);
                               },
                           .on_status =
                               [&](const LiveStatus& status) {
                                 const bool all = status.workers == std::int64_t{shape.processes} *
                                                                        shape.each.workers;
                                 if (run.connect_s == 0 && all)
                                   run.connect_s = seconds_since(launched);
                                 if (on_status) on_status(status);
                               }};
  const ServiceEnd end = (*service)->run({}, hooks);
  if (end.how != ServiceEnd::How::Finished) {
    return unexpected(ErrorKind::Unavailable, "the campaign did not end: " + end.reasons.front(),
                      "run");
  }
  run.wall_s = seconds_since(begin.value_or(launched));
  run.resident_mb = resident_mb();
  const CpuByThread after = cpu_by_thread();
  run.coordinator = {.main = after.main - before.main,
                     .io = after.io - before.io,
                     .writer = after.writer - before.writer};
  local->stop(std::chrono::seconds(5));
  run.workers_cpu_s = cpu_of_children() - children;
  service->reset();
  store->reset();
  run.store_mb = static_cast<double>(fs::file_size(folder.store())) / 1e6;
  return run;
}

}  // namespace swarmsmith::bench
