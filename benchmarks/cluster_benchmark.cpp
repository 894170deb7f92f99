// What does an evaluation cost the coordinator? Runs trivial evaluations through real sockets into
// a real store. Without arguments, prints the table of docs/performance.md.
//
//   cluster_benchmark [--evaluations N] [--processes P] [--workers-each W] [--slots S]
//                     [--spin-us T | --sleep-us T] [--window N] [--curve] [--memory] [--json]

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "benchmarks/cluster/flat_campaign.h"
#include "benchmarks/cluster/local_cluster.h"

namespace swarmsmith::bench {
namespace {

struct Case {
  std::int64_t evaluations = 300'000;
  std::int64_t window = 10'000;
  ClusterShape shape;
  bool memory = false;  ///< print a line for each half a million evaluations
};

void print_head() {
  std::printf(
      "| evaluations | of, us | CURVE | processes x workers x slots | all there after, s | "
      "evaluations/s | "
      "coordinator's CPU, us | main | I/O | writer | workers' CPU, us | coordinator's memory, MB | "
      "store, MB |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- "
      "|\n");
}

int measure(const Case& c, bool json) {
  FlatCampaign source(c.evaluations, c.window);
  ClusterShape shape = c.shape;
  shape.designs = source.designs();
  constexpr std::int64_t kEvery = 500'000;
  std::int64_t next = 0;
  const auto on_status = [&](const LiveStatus&) {
    if (!c.memory || source.told() < next) return;
    std::fprintf(stderr, "%lld evaluations: %.0f MB\n", static_cast<long long>(source.told()),
                 resident_mb());
    next = (source.told() / kEvery + 1) * kEvery;
  };
  const Expected<ClusterRun> run = run_cluster(shape, source, on_status);
  if (!run) return std::fprintf(stderr, "%s\n", to_string(run.error()).c_str()), 1;
  const auto n = static_cast<double>(c.evaluations);
  const CpuByThread& cpu = run->coordinator;
  const double each = 1e6 / n;
  std::printf(
      json ? "{\"evaluations\":%lld,\"work\":\"%s\",\"curve\":\"%s\",\"processes\":%d,\"workers_"
             "each\":%d,"
             "\"slots\":%d,\"connect_s\":%.2f,\"per_s\":%.0f,\"cpu_us\":%.2f,\"main_us\":%.2f,"
             "\"io_us\":%.2f,\"writer_us\":%.2f,\"workers_cpu_us\":%.2f,\"resident_mb\":%.0f,"
             "\"store_mb\":%.1f}\n"
           : "| %lld | %s | %s | %d x %d x %d | %.1f | %.0f | %.2f | %.2f | %.2f | %.2f | %.2f | "
             "%.0f | "
             "%.1f |\n",
      static_cast<long long>(c.evaluations), to_text(shape.work).c_str(),
      shape.curve ? "on" : "off", shape.processes, shape.each.workers, shape.each.slots,
      run->connect_s, n / run->wall_s, each * cpu.all(), each * cpu.main, each * cpu.io,
      each * cpu.writer, each * run->workers_cpu_s, run->resident_mb, run->store_mb);
  std::fflush(stdout);
  return 0;
}

int measure_all() {
  print_head();
  int failed = 0;
  for (const int processes : {1, 2, 8}) {
    for (const bool curve : {false, true}) {
      Case c;
      c.shape.processes = processes;
      c.shape.curve = curve;
      failed += measure(c, false);
    }
  }
  Case busy;
  busy.evaluations = 20'000;
  busy.shape.processes = 2;
  busy.shape.curve = true;
  busy.shape.work.us = 300;
  return failed + measure(busy, false);
}

int run(int argc, char** argv) {
  if (argc == 1) return measure_all();
  Case c;
  bool json = false;
  std::int64_t spin_us = 0;
  std::int64_t sleep_us = 0;
  CLI::App app{"Trivial evaluations through real sockets into a real store"};
  app.add_option("--evaluations", c.evaluations)->check(CLI::PositiveNumber);
  app.add_option("--processes", c.shape.processes, "Worker processes");
  app.add_option("--workers-each", c.shape.each.workers, "Workers in each process");
  app.add_option("--slots", c.shape.each.slots, "Slots of each worker");
  app.add_option("--spin-us", spin_us, "An evaluation computes so long");
  app.add_option("--sleep-us", sleep_us, "An evaluation waits so long, +- 30 %");
  app.add_option("--window", c.window, "Tasks that are wanted at a time");
  app.add_flag("--curve", c.shape.curve, "Encrypt the connections");
  app.add_flag("--memory", c.memory, "Say what the coordinator takes, on the way");
  app.add_flag("--json", json);
  CLI11_PARSE(app, argc, argv);
  c.shape.work = sleep_us > 0 ? Work{.kind = Work::Kind::Sleep, .us = sleep_us, .spread = 0.3}
                              : Work{.kind = Work::Kind::Spin, .us = spin_us};
  if (!json) print_head();
  return measure(c, json);
}

}  // namespace
}  // namespace swarmsmith::bench

int main(int argc, char** argv) {
  if (swarmsmith::bench::is_worker()) swarmsmith::bench::be_worker();
  swarmsmith::bench::raise_descriptor_limit();
  return swarmsmith::bench::run(argc, argv);
}
