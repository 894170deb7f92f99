#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <ctime>
#include <numeric>
#include <vector>

#include "base/hash.h"
#include "base/rng.h"
#include "irace_core/internal/model.h"
#include "irace_core/internal/race.h"
#include "irace_core/internal/sampling.h"
#include "irace_core/iterated_race.h"
#include "tests/irace_core/spaces.h"

// The cost of iterated racing itself: one test step, a whole design of 100,000 experiments on
// AutoMoDe's 149 parameters with a target that costs nothing, and the sampling of 1,000
// configurations of that space.

namespace swarmsmith::irace {
namespace {

/// CPU time of this thread, which does not include other programs on the machine.
double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

/// The quality of a configuration with noise: one in a hundred is good, and the tests drop most of
/// the others.
double noisy_cost(std::size_t column, Rng& rng) {
  return static_cast<double>(column % 100) / 50 + rng.uniform();
}

/// Measures the fifth task of a first race with as many candidates as the argument: its costs
/// arrive, are ranked and tested, and the losers are removed from all sums.
void test_step(benchmark::State& state, TestType type) {
  RaceSettings settings{.test_type = type,
                        .min_survival = 9,
                        .max_experiments = 100'000,
                        .pairs = std::vector<std::int64_t>(100)};
  std::iota(settings.pairs.begin(), settings.pairs.end(), std::int64_t{1});
  settings.one_task_at_a_time = true;
  std::vector<Contestant> contestants;
  for (std::int64_t id = 1; id <= state.range(0); ++id)
    contestants.push_back({id, {}, {}});
  Rng rng(1);
  std::size_t alive = 0;
  for (auto _ : state) {
    Race race(settings, contestants);
    for (int task = 1; task <= settings.first_test; ++task) {
      std::vector<Measurement> answers;
      for (const RaceRun& run : race.wanted())
        answers.push_back({noisy_cost(run.column, rng), 0});
      const double start = cpu_seconds();
      race.tell(answers);
      if (task == settings.first_test) state.SetIterationTime(cpu_seconds() - start);
    }
    alive = race.alive_count();
  }
  state.counters["alive"] = static_cast<double>(alive);
}
BENCHMARK_CAPTURE(test_step, f_test, TestType::FTest)->Arg(1000)->UseManualTime();
BENCHMARK_CAPTURE(test_step, t_test, TestType::TTest)->Arg(1000)->UseManualTime();
BENCHMARK_CAPTURE(test_step, t_test_holm, TestType::TTestHolm)->Arg(1000)->UseManualTime();

Scenario hundred_thousand(TestType type) {
  Scenario scenario;
  scenario.max_experiments = 100'000;
  scenario.seed = 3;
  scenario.test_type = type;
  return scenario;
}

/// Largest memory of the process so far, MB.
double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

/// A quality from a few bits of the configuration, and noise: a target that costs nothing.
double trivial_cost(const Configuration& configuration, const Experiment& experiment) {
  const double quality = configuration[0] + (configuration.is_active(1) ? configuration[1] : 4);
  const std::uint64_t noise = mix64(static_cast<std::uint64_t>(experiment.seed) ^
                                    (static_cast<std::uint64_t>(experiment.configuration) << 32U));
  return quality + static_cast<double>(noise >> 11U) * 0x1p-51;
}

void design(benchmark::State& state, TestType type, bool one_task_at_a_time) {
  static const double memory_before = peak_memory();  // before the first design
  std::int64_t used = 0;
  double in_race = 0;
  for (auto _ : state) {
    Scenario scenario = hundred_thousand(type);
    scenario.one_task_at_a_time = one_task_at_a_time;
    double begun = cpu_seconds();
    auto race = IteratedRace::start(testing::automode_space(), scenario).value();
    in_race += cpu_seconds() - begun;
    std::vector<double> costs;
    while (!race.finished()) {
      costs.clear();
      for (const Experiment& wanted : race.wanted())
        costs.push_back(trivial_cost(race.configuration(wanted.configuration), wanted));
      begun = cpu_seconds();
      race.tell(costs);
      benchmark::DoNotOptimize(race.take_events());
      in_race += cpu_seconds() - begun;
    }
    used += race.experiments_used();
  }
  state.counters["us_each"] = in_race / static_cast<double>(used) * 1e6;
  state.counters["evaluations"] =
      static_cast<double>(used) / static_cast<double>(state.iterations());
  state.counters["peak_MB_more"] = peak_memory() - memory_before;
}
BENCHMARK_CAPTURE(design, f_test, TestType::FTest, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(design, t_test, TestType::TTest, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(design, f_test_single_tasks, TestType::FTest, true)
    ->Unit(benchmark::kMillisecond);

/// The first race of such a design, with all its configurations, about a thousand.
void first_configurations(benchmark::State& state) {
  std::int64_t sampled = 0;
  for (auto _ : state) {
    auto race =
        IteratedRace::start(testing::automode_space(), hundred_thousand(TestType::FTest)).value();
    sampled = race.n_configurations();
  }
  state.counters["configurations"] = static_cast<double>(sampled);
}
BENCHMARK(first_configurations)->Unit(benchmark::kMillisecond);

constexpr int kSampled = 1000;

void uniform_configurations(benchmark::State& state) {
  const ParameterSpace space = testing::automode_space();
  Rng rng(1);
  for (auto _ : state) {
    for (int i = 0; i < kSampled; ++i)
      benchmark::DoNotOptimize(sample_uniform(space, rng).value());
  }
}
BENCHMARK(uniform_configurations)->Unit(benchmark::kMillisecond);

/// Configurations from the models of nine elites, after their first update.
void configurations_of_models(benchmark::State& state) {
  const ParameterSpace space = testing::automode_space();
  Rng rng(1);
  std::vector<Configuration> elites;
  std::vector<EliteLine> lines;
  for (int i = 0; i < 9; ++i)
    elites.push_back(sample_uniform(space, rng).value());
  for (std::size_t i = 0; i < elites.size(); ++i)
    lines.push_back({static_cast<std::int64_t>(i) + 1, 0, &elites[i]});
  SamplingModels models(space);
  models.initialise(lines);
  models.update(lines, update_strength(2, 9, kSampled, space.variable_count()));
  for (auto _ : state) {
    for (int i = 0; i < kSampled; ++i) {
      const auto parent = static_cast<std::int64_t>(draw_parent(elites.size(), rng)) + 1;
      benchmark::DoNotOptimize(models.sample(parent, rng).value());
    }
  }
}
BENCHMARK(configurations_of_models)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace swarmsmith::irace
