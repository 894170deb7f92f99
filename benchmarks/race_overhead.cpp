// The cost of the race itself: the space of a campaign's machines, with a target of one line.
//
//   race_overhead CAMPAIGN BUDGET
//
// Prints a JSON object: experiments, seconds of CPU, peak memory in MB.

#include <fmt/format.h>
#include <sys/resource.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "coordinator/campaign/campaign_file.h"
#include "coordinator/campaign/machine_space.h"
#include "irace_core/iterated_race.h"

namespace swarmsmith {
namespace {

[[noreturn]] void give_up(const std::string& why) {
  std::fprintf(stderr, "race_overhead: %s\n", why.c_str());
  std::exit(2);
}

double fraction(double x) {
  return x - std::floor(x);
}

/// A different quality for each configuration, and noise of the same size;
/// benchmarks/irace_overhead gives R the same function.
double cost_of(const Experiment& experiment) {
  const auto id = static_cast<double>(experiment.configuration);
  const auto seed = static_cast<double>(experiment.seed);
  return fraction(id * 0.6180339887498949) +
         fraction(id * 0.7548776662466927 + seed * 0.5698402909980532);
}

/// Answers all experiments; returns their number.
std::int64_t run(IteratedRace& race) {
  std::int64_t experiments = 0;
  std::vector<double> costs;
  while (!race.finished()) {
    costs.clear();
    for (const Experiment& wanted : race.wanted())
      costs.push_back(cost_of(wanted));
    experiments += static_cast<std::int64_t>(costs.size());
    race.tell(costs);
    race.take_events();
  }
  if (race.failure()) give_up(to_string(*race.failure()));
  return experiments;
}

}  // namespace
}  // namespace swarmsmith

int main(int count, char** words) {
  using namespace swarmsmith;
  if (count != 3) give_up("usage: race_overhead CAMPAIGN BUDGET");
  const std::int64_t budget = std::atoll(words[2]);
  const auto campaign = read_campaign(words[1], budget);
  if (!campaign) give_up(to_string(campaign.error().front()));
  const Method& method = campaign->methods.front();
  const auto flavour = flavour_of(method);
  auto space = MachineSpace::in_grammar(method, **flavour, static_cast<int>(campaign->digits));
  if (!space) give_up(to_string(space.error()));
  Scenario scenario = campaign->race;
  scenario.max_experiments = budget;
  auto race = IteratedRace::start(std::move(*space), scenario);
  if (!race) give_up(to_string(race.error()));
  const std::int64_t experiments = run(*race);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const double cpu = static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
                     1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
  fmt::print("{{\"experiments\":{},\"cpu_s\":{:.3f},\"peak_mb\":{:.0f}}}\n", experiments, cpu,
             static_cast<double>(usage.ru_maxrss) / 1024);
  return 0;
}
