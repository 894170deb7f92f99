// What does an evaluation cost the coordinator? Trivial evaluations through real sockets, into a
// real store, with worker processes of one slot each.
//
//   cluster_benchmark [EVALUATIONS [WORKERS [WORK_US]]]

#include <sys/resource.h>
#include <unistd.h>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

#include "base/hash.h"
#include "coordinator/launchers/local_workers.h"
#include "coordinator/service.h"
#include "worker/pool.h"
#include "worker/service.h"
#include "worker/slots.h"

namespace swarmsmith {
namespace {

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

double cpu_of_process() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
}

double cpu_of_thread() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Independent tasks, some ten thousand wanted at a time.
class FlatCampaign final : public WorkSource {
 public:
  explicit FlatCampaign(std::int64_t total) : total_(total) {}

  std::vector<Task> take_tasks() override {
    std::vector<Task> tasks;
    while (asked_ < total_ && asked_ - told_ < kWindow) {
      const std::int64_t i = asked_++;
      if (i % 100 == 0) {
        rows_.emplace_back(std::in_place_type<CandidateRow>);
        auto& candidate = std::get<CandidateRow>(rows_.back());
        candidate.id = {i / 100 + 1};
        candidate.iteration = 1;
        candidate.parameters = "{}";
        candidate.modules = "{}";
      }
      tasks.push_back({.key = {{i / 100 + 1}, Purpose::Race, i % 100 + 1},
                       .seed = i,
                       .machine = std::string(160, 'x')});
    }
    return tasks;
  }
  void tell(const Outcome& outcome) override {
    ++told_;
    rows_.emplace_back(EvaluationRow{.key = outcome.key,
                                     .iteration = 1,
                                     .status = outcome.status,
                                     .score = outcome.score,
                                     .state_digest = outcome.state_digest,
                                     .source = "rvr",
                                     .wall_us = outcome.wall_us,
                                     .worker = outcome.worker,
                                     .attempt = outcome.attempt});
  }
  std::vector<Row> take_rows() override { return std::exchange(rows_, {}); }
  bool finished() const override { return told_ == total_; }

 private:
  static constexpr std::int64_t kWindow = 10'000;
  std::int64_t total_;
  std::int64_t asked_ = 0;
  std::int64_t told_ = 0;
  std::vector<Row> rows_;
};

Expected<Evaluator> make_spinner(const std::string& work_us) {
  const std::chrono::microseconds work(std::stol(work_us));
  return Evaluator([work](const WorkItem& item) -> tl::expected<Measured, Failure> {
    const auto until = std::chrono::steady_clock::now() + work;
    while (work.count() > 0 && std::chrono::steady_clock::now() < until) {
    }
    return Measured{.score = static_cast<double>(item.seed),
                    .state_digest = mix64(static_cast<std::uint64_t>(item.seed))};
  });
}

int be_worker(const std::string& endpoint) {
  Wakeup wakeup;
  Pool pool(1, make_spinner, [&wakeup] { wakeup.notify(); });
  const std::atomic<bool> drain{false};
  const WorkerEnd end = serve({.endpoint = endpoint, .protocol = {}, .socket = {}},
                              identity_of_this_process(1, "benchmark"), pool, wakeup, drain);
  std::_Exit(static_cast<int>(end.code));
}

int measure(std::int64_t evaluations, int workers, const std::string& work_us) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("cluster_benchmark." + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  CampaignRow campaign;
  campaign.name = "benchmark";
  campaign.digest = "benchmark";
  campaign.deciding = "{}";
  DesignRow design;
  design.id = {1};
  design.mission = "m";
  design.method = "m";
  auto store = Store::open(folder / "store.db", campaign, {design});
  if (!store) return std::fprintf(stderr, "%s\n", to_string(store.error()).c_str()), 1;
  FlatCampaign source(evaluations);
  ServiceOptions options;
  options.coordinator.scenario = work_us;
  auto service = Service::open(options, {{"benchmark", store->get(), &source}});
  if (!service) return std::fprintf(stderr, "%s\n", to_string(service.error()).c_str()), 1;
  setenv("SWARMSMITH_BENCHMARK_WORKER", (*service)->endpoint().c_str(), 1);
  auto local = LocalWorkers::start({.endpoint = (*service)->endpoint(),
                                    .processes = workers,
                                    .slots = 1,
                                    .program = "/proc/self/exe",
                                    .arguments = {}});
  if (!local) return std::fprintf(stderr, "%s\n", to_string(local.error()).c_str()), 1;

  const double process_before = cpu_of_process();
  const double thread_before = cpu_of_thread();
  const auto begin = std::chrono::steady_clock::now();
  const ServiceEnd end = (*service)->run({}, {});
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  const double main_us = 1e6 * (cpu_of_thread() - thread_before) / static_cast<double>(evaluations);
  const double all_us =
      1e6 * (cpu_of_process() - process_before) / static_cast<double>(evaluations);
  std::printf(
      "%lld evaluations of %s us, %d workers: %.0f/s; coordinator CPU %.2f us each, "
      "%.2f of it in the main thread%s\n",
      static_cast<long long>(evaluations), work_us.c_str(), workers,
      static_cast<double>(evaluations) / wall.count(), all_us, main_us,
      end.how == ServiceEnd::How::Finished ? "" : " (NOT FINISHED)");
  service->reset();
  store->reset();
  std::filesystem::remove_all(folder);
  return 0;
}

}  // namespace
}  // namespace swarmsmith

int main(int argc, char** argv) {
  if (const char* endpoint = std::getenv("SWARMSMITH_BENCHMARK_WORKER"); endpoint != nullptr) {
    return swarmsmith::be_worker(endpoint);
  }
  const auto argument = [&](int i, const char* fallback) { return i < argc ? argv[i] : fallback; };
  if (argc > 1) {
    return swarmsmith::measure(std::atoll(argument(1, "")), std::atoi(argument(2, "2")),
                               argument(3, "0"));
  }
  return swarmsmith::measure(300'000, 2, "0") + swarmsmith::measure(20'000, 2, "300");
}
