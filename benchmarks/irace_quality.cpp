// The results of our races on the benchmark `colony`, compared with R's irace.
//
//   irace_quality DATA PICTURE [ROWS [REPETITIONS]]
//
// DATA is benchmarks/data/irace_colony_r.csv. Runs 20 races (or REPETITIONS) with each of its
// budgets in this process. Writes PICTURE as SVG and ROWS as CSV like DATA; the table goes to the
// standard output as Markdown. The exit code is 1 if our winners are significantly worse at 1 %.

#include <fmt/format.h>

#include <array>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "analysis/figures/box_plot.h"
#include "analysis/statistics/summary.h"
#include "analysis/statistics/wilcoxon.h"
#include "benchmarks/colony/colony.h"
#include "irace_core/iterated_race.h"

namespace swarmsmith {
namespace {

constexpr std::array<std::int64_t, 4> kBudgets = {1000, 5000, 20'000, 100'000};
/// R's programs in DATA: the one in which the sampling of ordinals is corrected, and the original.
constexpr const char* kMended = "R-4.4.3-ordinal-fixed";
constexpr const char* kUnmended = "R-4.4.3";

[[noreturn]] void give_up(const std::string& why) {
  std::fprintf(stderr, "irace_quality: %s\n", why.c_str());
  std::exit(2);
}

/// True costs of the winners, by engine and budget.
using Costs = std::map<std::pair<std::string, std::int64_t>, std::vector<double>>;

Costs read_costs(const char* file) {
  std::ifstream stream(file);
  if (!stream) give_up(std::string(file) + " cannot be read");
  Costs costs;
  std::string line;
  std::getline(stream, line);  // engine,benchmark,budget,seed,cost,n_experiments_used
  while (std::getline(stream, line)) {
    std::istringstream cells(line);
    std::array<std::string, 5> cell;
    for (std::string& one : cell)
      std::getline(cells, one, ',');
    costs[{cell[0], std::stoll(cell[2])}].push_back(std::stod(cell[4]));
  }
  return costs;
}

struct Result {
  double cost = 0;
  std::int64_t used = 0;
};

Result tune(std::int64_t budget, std::uint64_t seed) {
  Scenario scenario;
  scenario.max_experiments = budget;
  scenario.n_instances = colony::kInstances;
  scenario.seed = seed;
  auto race = IteratedRace::start(colony::space(), scenario);
  if (!race) give_up(to_string(race.error()));
  std::int64_t calls = 0;
  std::vector<double> costs;
  while (!race->finished()) {
    costs.clear();
    for (const Experiment& wanted : race->wanted()) {
      costs.push_back(
          colony::cost(race->configuration(wanted.configuration), wanted.instance, wanted.seed));
    }
    calls += static_cast<std::int64_t>(costs.size());
    race->tell(costs);
    race->take_events();
  }
  if (race->failure()) give_up(to_string(*race->failure()));
  if (calls > budget) give_up(fmt::format("{} calls at a budget of {}", calls, budget));
  return {colony::true_cost(race->configuration(race->elites().front().configuration)), calls};
}

/// Runs all repetitions with a budget, on all cores.
std::vector<Result> tune_all(std::int64_t budget, std::size_t repetitions) {
  std::vector<Result> results(repetitions);
  std::atomic<std::size_t> next = 0;
  std::vector<std::thread> threads;
  for (unsigned i = 0; i < std::max(1U, std::thread::hardware_concurrency()); ++i) {
    threads.emplace_back([&] {
      for (std::size_t k = next++; k < results.size(); k = next++)
        results[k] = tune(budget, k + 1);
    });
  }
  for (std::thread& thread : threads)
    thread.join();
  return results;
}

/// Median true cost of a thousand first configurations, without racing.
double median_of_random() {
  Scenario scenario;
  scenario.max_experiments = 100'000;
  scenario.n_instances = colony::kInstances;
  scenario.seed = 1;
  auto race = IteratedRace::start(colony::space(), scenario);
  if (!race) give_up(to_string(race.error()));
  std::vector<double> costs;
  for (const RaceEvent& event : race->take_events()) {
    const auto* sampled = std::get_if<ConfigurationSampled>(&event);
    if (sampled != nullptr) costs.push_back(colony::true_cost(sampled->configuration));
  }
  return box_numbers(costs).median;
}

void write(const std::string& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) give_up(file + " cannot be written");
}

}  // namespace
}  // namespace swarmsmith

int main(int count, char** words) {
  using namespace swarmsmith;
  if (count < 3 || count > 5) give_up("usage: irace_quality DATA PICTURE [ROWS [REPETITIONS]]");
  const auto repetitions =
      static_cast<std::size_t>(count == 5 ? std::max(1, std::atoi(words[4])) : 20);
  const Costs of_r = read_costs(words[1]);
  std::string rows = "engine,benchmark,budget,seed,cost,n_experiments_used\n";
  ScorePanel boxes{.title = "R's irace and ours, by budget", .groups = {}};
  bool worse = false;
  fmt::print(
      "| budget | R, median (n) | R with its defect | ours, median (n) | ours / R | p (ours worse) "
      "| "
      "calls, most |\n| --- | --- | --- | --- | --- | --- | --- |\n");
  for (const std::int64_t budget : kBudgets) {
    std::vector<double> ours;
    std::int64_t most = 0;
    const std::vector<Result> results = tune_all(budget, repetitions);
    for (std::size_t i = 0; i < results.size(); ++i) {
      ours.push_back(results[i].cost);
      most = std::max(most, results[i].used);
      rows += fmt::format("swarmsmith,colony,{},{},{:.8g},{}\n", budget, i + 1, results[i].cost,
                          results[i].used);
    }
    const std::vector<double>& mended = of_r.at({kMended, budget});
    const auto unmended = of_r.find({kUnmended, budget});
    // If all costs are equal, this side has p = 1, so there is always a value.
    const double p = *rank_sum_test(ours, mended, Alternative::Greater).p_value;
    worse = worse || p < 0.01;
    const double median = box_numbers(ours).median;
    const double median_of_r = box_numbers(mended).median;
    fmt::print(
        "| {} | {:.4f} ({}) | {} | {:.4f} ({}) | {:.3f} | {:.3f} | {} |\n", budget, median_of_r,
        mended.size(),
        unmended == of_r.end() ? "" : fmt::format("{:.4f}", box_numbers(unmended->second).median),
        median, ours.size(), median / median_of_r, p, most);
    std::fflush(stdout);
    boxes.groups.push_back({"R " + std::to_string(budget), 0, mended});
    boxes.groups.push_back({"ours " + std::to_string(budget), 1, ours});
  }
  fmt::print("\nRandom configurations: median {:.4f}.\n", median_of_random());
  write(words[2], draw(BoxPlot{.title = "True cost of the winners on the benchmark colony",
                               .details = {},
                               .axis = "true cost of the winner (smaller is better)",
                               .panels = {std::move(boxes)},
                               .width_mm = 131}));
  if (count >= 4) write(words[3], rows);
  return worse ? 1 : 0;
}
