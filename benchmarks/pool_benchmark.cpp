// How busy are the slots of a pool that several designs share? Coordinator, sockets, store and
// worker processes are real; evaluations wait instead of computing, so that a small machine has
// many slots. Races are real ones over synthetic scores, or proceed like recorded ones.
//
//   pool_benchmark [--designs N] [--budget N | --recorded FILE [--ahead N]]
//                  [--processes P] [--slots S] [--sleep-us T] [--curve] [--memory] [--keep N]

#include <malloc.h>
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "benchmarks/cluster/local_cluster.h"
#include "benchmarks/cluster/recorded_races.h"
#include "coordinator/campaign/campaign_file.h"
#include "coordinator/design/campaign_runner.h"
#include "coordinator/design/plans.h"

namespace swarmsmith::bench {
namespace {

struct Case {
  int designs = 10;
  std::int64_t budget = 5'000;
  std::string recorded;
  std::size_t ahead = 0;  ///< for recorded races
  bool memory = false;
  std::size_t keep =
      0;  ///< number of finished races to keep, whatever their size; 0: the programs' default
  ClusterShape shape{.processes = 8, .each = {.slots = 8}};
};

/// Time that slots were working, over the middle half of a campaign's evaluations.
class BusyTime {
 public:
  explicit BusyTime(std::int64_t total) : from_(total / 4), to_(total - total / 4) {}

  void add(std::span<const Row> rows) {
    for (const Row& row : rows) {
      const auto* evaluation = std::get_if<EvaluationRow>(&row);
      if (evaluation == nullptr) continue;
      // The second row of an evaluation that was made ahead: a race uses the result.
      if (evaluation->worker == 0) {
        --unused_;
        continue;
      }
      if (evaluation->iteration == 0 && evaluation->key.purpose == Purpose::Race) ++unused_;
      ++done_;
      if (done_ == from_) begin_ = Clock::now();
      if (done_ > from_ && done_ <= to_) busy_us_ += evaluation->wall_us;
      if (done_ == to_) end_ = Clock::now();
    }
  }
  double share(int slots) const {
    const double wall_us = std::chrono::duration<double, std::micro>(end_ - begin_).count();
    return static_cast<double>(busy_us_) / (wall_us * slots);
  }
  double rate() const {
    return static_cast<double>(to_ - from_) / std::chrono::duration<double>(end_ - begin_).count();
  }
  std::int64_t done() const { return done_; }
  /// Number of look-ahead evaluations that no race has used; the rows of recorded races do not show
  /// it.
  std::int64_t unused() const { return unused_; }

 private:
  using Clock = std::chrono::steady_clock;
  std::int64_t from_;
  std::int64_t to_;
  std::int64_t done_ = 0;
  std::int64_t unused_ = 0;
  std::int64_t busy_us_ = 0;
  Clock::time_point begin_;
  Clock::time_point end_;
};

/// The designs of a campaign with real races, but without a real simulator.
Expected<std::vector<DesignPlan>> plans_for(const Case& c) {
  const std::string text =
      "format = 1\n[campaign]\nrepetitions = " + std::to_string(c.designs) +
      "\n[[mission]]\nname = \"aggregation\"\n[[method]]\nname = \"watermelon\"\n"
      "flavour = \"watermelon\"\n[race]\nmax_experiments = " +
      std::to_string(c.budget) + "\n[simulator]\nprofile = \"argos3\"\n";
  const CampaignOrErrors campaign = parse_campaign(text, "pool.toml");
  if (!campaign) return Unexpected(campaign.error().front());
  return plans_of(*campaign);
}

int report(const Case& c, const Expected<ClusterRun>& run, const BusyTime& busy,
           std::int64_t unused) {
  if (!run) return std::fprintf(stderr, "%s\n", to_string(run.error()).c_str()), 1;
  if (c.memory) std::fprintf(stderr, "at the end: %.0f MB\n", run->resident_mb);
  const int slots = c.shape.processes * c.shape.each.slots;
  // Over the whole campaign including its end; unused evaluations do not count.
  const double efficiency =
      static_cast<double>((busy.done() - unused) * c.shape.work.us) / (1e6 * run->wall_s * slots);
  std::printf("| %d | %s | %d x %d | %.1f | %lld | %.0f | %.1f %% | %.1f %% | %.1f %% | %.1f |\n",
              c.designs, c.recorded.empty() ? std::to_string(c.budget).c_str() : "recorded",
              c.shape.processes, c.shape.each.slots, 1e-3 * static_cast<double>(c.shape.work.us),
              static_cast<long long>(busy.done()), busy.rate(), 100 * busy.share(slots),
              100 * static_cast<double>(unused) / static_cast<double>(busy.done()),
              100 * efficiency, 1e6 * run->coordinator.all() / static_cast<double>(busy.done()));
  return 0;
}

/// Prints the coordinator's memory after each half a million evaluations.
std::function<void(const LiveStatus&)> watch_of(const Case& c) {
  if (!c.memory) return {};
  constexpr std::int64_t kEvery = 500'000;
  return [next = std::int64_t{0}](const LiveStatus& status) mutable {
    if (status.done < next) return;
    std::fprintf(stderr, "%lld evaluations: %.0f MB\n", static_cast<long long>(status.done),
                 resident_mb());
    next = (status.done / kEvery + 1) * kEvery;
  };
}

int measure(Case& c) {
  std::printf(
      "| designs | budget of each | processes x slots | ms an evaluation | evaluations | "
      "evaluations/s | busy slots | made ahead and not used | efficiency of the whole | "
      "coordinator's CPU, us |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  c.shape.designs = c.designs;
  if (!c.recorded.empty()) {
    const auto races = read_races(c.recorded);
    if (!races) return std::fprintf(stderr, "%s\n", to_string(races.error()).c_str()), 1;
    RecordedRaces source(*races, c.designs, c.ahead);
    BusyTime busy(source.total());
    const auto run =
        run_cluster(c.shape, source, watch_of(c), [&](const auto& rows) { busy.add(rows); });
    return report(c, run, busy, source.told() - source.total());
  }
  auto plans = plans_for(c);
  if (!plans) return std::fprintf(stderr, "%s\n", to_string(plans.error()).c_str()), 1;
  OpenDesigns open;
  if (c.keep > 0) {
    open.finished = c.keep;
    open.finished_experiments = std::numeric_limits<std::int64_t>::max();
  }
  CampaignRunner source(std::move(*plans), {}, {}, {}, open);
  BusyTime busy(c.budget * c.designs);
  const auto run =
      run_cluster(c.shape, source, watch_of(c), [&](const auto& rows) { busy.add(rows); });
  return report(c, run, busy, busy.unused());
}

int run(int argc, char** argv) {
  Case c;
  c.shape.work = {.kind = Work::Kind::Sleep, .us = 20'000, .spread = 0.3};
  CLI::App app{"How busy the slots of a pool are that several designs share"};
  app.add_option("--designs", c.designs);
  app.add_option("--budget", c.budget, "Experiments of each design");
  app.add_option("--recorded", c.recorded, "Races that go like those of this file");
  app.add_flag("--curve", c.shape.curve, "Encrypt the connections");
  app.add_option("--ahead", c.ahead, "Tests that recorded races look ahead, at most");
  app.add_flag("--memory", c.memory, "Say what the coordinator takes, on the way");
  app.add_option("--keep", c.keep, "Finished races in memory, whatever their size");
  app.add_option("--processes", c.shape.processes);
  app.add_option("--slots", c.shape.each.slots, "Of each process");
  app.add_option("--sleep-us", c.shape.work.us, "Mean time of an evaluation, +- 30 %");
  CLI11_PARSE(app, argc, argv);
  return measure(c);
}

}  // namespace
}  // namespace swarmsmith::bench

int main(int argc, char** argv) {
  if (swarmsmith::bench::is_worker()) swarmsmith::bench::be_worker();
  mallopt(M_ARENA_MAX, 1);  // the same setting as in `run`
  return swarmsmith::bench::run(argc, argv);
}
