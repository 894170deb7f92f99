// How many cores can a campaign use? Runs the model of benchmarks/cluster/pool_model.h on races
// that proceed like recorded ones (benchmarks/record_races). Useful efficiency is evaluations that
// count x time / (cores x wall time), over whole campaigns from the first evaluation to the last.
//
//   efficiency_model RACES.csv                   the table of docs/performance.md, as CSV
//   efficiency_model RACES.csv SLOTS WORKER_SLOTS MS DESIGNS AHEAD    one case

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "benchmarks/cluster/pool_model.h"

namespace swarmsmith::bench {
namespace {

void print_case(const std::vector<RecordedRace>& races, const ModelShape& shape, int designs,
                std::size_t ahead) {
  RecordedRaces source(races, designs, ahead);
  const ModelRun run = run_model(shape, source);
  std::printf("%lld,%g,%d,%zu,%.4f,%.4f,%.2f\n", static_cast<long long>(shape.slots),
              1e-3 * shape.us, designs, ahead, run.efficiency, run.extra, run.wall_s);
  std::fflush(stdout);
}

void print_all(const std::vector<RecordedRace>& races) {
  struct Kind {
    int designs;
    std::size_t ahead;
  };
  for (const int slots : {8, 64, 256, 1024, 4096}) {
    for (const double ms : {2.0, 5.0, 50.0}) {
      for (const Kind kind : {Kind{1, 0}, Kind{1, 3}, Kind{1, 10}, Kind{10, 0}, Kind{10, 3},
                              Kind{10, 10}, Kind{40, 0}, Kind{40, 3}}) {
        print_case(races, {.slots = slots, .us = 1e3 * ms}, kind.designs, kind.ahead);
      }
    }
  }
}

int run(int argc, char** argv) {
  if (argc != 2 && argc != 7) {
    return std::fprintf(stderr,
                        "usage: efficiency_model RACES.csv [SLOTS WORKER_SLOTS MS DESIGNS "
                        "AHEAD]\n"),
           2;
  }
  const auto races = read_races(argv[1]);
  if (!races) return std::fprintf(stderr, "%s\n", to_string(races.error()).c_str()), 1;
  std::printf("cores,ms,designs,ahead,efficiency,extra,wall_s\n");
  if (argc == 2) return print_all(*races), 0;
  const ModelShape shape{.slots = std::atoll(argv[2]),
                         .worker_slots = std::atoll(argv[3]),
                         .us = 1e3 * std::atof(argv[4])};
  print_case(*races, shape, std::atoi(argv[5]), static_cast<std::size_t>(std::atoi(argv[6])));
  return 0;
}

}  // namespace
}  // namespace swarmsmith::bench

int main(int argc, char** argv) {
  return swarmsmith::bench::run(argc, argv);
}
