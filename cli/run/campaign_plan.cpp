#include "cli/run/campaign_plan.h"

#include <time.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "base/text/json.h"
#include "base/usable_processors.h"
#include "cli/run/campaign_warnings.h"
#include "console/output.h"
#include "coordinator/campaign/campaign_rows.h"
#include "coordinator/campaign/method_space.h"
#include "irace_core/search/start_search.h"
#include "sim/engine/simulate.h"

namespace swarmsmith::cli {
namespace {

/// Measured on stores of 12k and 100k evaluations: the size of an evaluation with its candidate
/// and step, and what it adds to the log until the log is folded into the store.
constexpr double kBytesPerEvaluation = 120;
constexpr double kLogBytesPerEvaluation = 1300;
constexpr double kLargestLog = 10e6;
/// For all missions and methods together.
constexpr double kMeasured_s = 0.5;
/// For racing, storing and messages.
constexpr double kOverhead_s = 30e-6;

/// Processor time of this thread, independent of other load.
double processor_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The first controllers that the method's search would try.
std::vector<Controller> some_controllers(const Campaign& campaign, const Method& method) {
  constexpr std::size_t kControllers = 50;
  std::vector<Controller> controllers;
  auto space = MethodSpace::make(method, static_cast<int>(campaign.digits));
  if (!space) return controllers;
  auto search = start_search(space->parameters(), campaign.race, method.search, {}, {},
                             space->neighbourhood());
  if (!search) return controllers;
  for (const RaceEvent& event : (*search)->take_events()) {
    const auto* sampled = std::get_if<ConfigurationSampled>(&event);
    if (sampled == nullptr) continue;
    controllers.push_back(space->controller_of(sampled->configuration));
    if (controllers.size() == kControllers) break;
  }
  return controllers;
}

/// Measurements of random machines.
struct RandomRuns {
  double evaluation_s = 0;  ///< mean
  std::int64_t runs = 0;    ///< that covered the whole mission
  double least = 0;         ///< lowest score
  double most = 0;
  bool finite = true;
};

/// Warns about a score that is never a number or always the same, because that is probably a
/// mistake.
void warn_about_scores(const std::string& mission, const RandomRuns& measured,
                       std::vector<std::string>& warnings) {
  constexpr std::int64_t kEnough = 20;
  if (!measured.finite) {
    warnings.push_back(
        "mission " + mission +
        ": a random machine's score is not a finite number; a race rejects such machines");
  } else if (measured.runs >= kEnough && measured.least == measured.most) {
    warnings.push_back("mission " + mission + ": " + std::to_string(measured.runs) +
                       " runs of random machines all scored " + json_number(measured.most) +
                       "; is any other score possible?");
  }
}

/// Simulates evaluations of the method on the mission, as many as fit into `budget_s`. If the
/// mission is too long for that, simulates its beginning, as much as fits.
RandomRuns measure(const Campaign& campaign, const Method& method, const Mission& mission,
                   double budget_s) {
  const Flavour flavour =
      find_flavour(method.flavour, method.turn_clock, method.own_flavour).value();
  const std::vector<Controller> controllers = some_controllers(campaign, method);
  constexpr int kFirstCycles = 50;
  constexpr int kGrowth = 4;
  Mission piece = mission;
  piece.cycles = std::min(mission.cycles, kFirstCycles);
  double elapsed_s = 0;  // total of all runs
  double counted_s = 0;  // of the runs as long as the last one
  std::int64_t runs = 0;
  RandomRuns measured;
  constexpr std::int64_t kMostSeeds = 100'000;  // a limit in case no seed finds room for the swarm
  for (std::int64_t seed = 1;
       seed <= kMostSeeds && !controllers.empty() && (runs == 0 || elapsed_s < budget_s); ++seed) {
    const Controller& controller = controllers[static_cast<std::size_t>(seed) % controllers.size()];
    const auto instance = instance_of(mission, seed);
    if (!instance) continue;
    const double begin = processor_s();
    const double score = simulate({.controller = controller,
                                   .flavour = flavour,
                                   .profile = campaign.profile,
                                   .mission = piece,
                                   .instance = *instance,
                                   .seed = seed})
                             .score;
    measured.finite = measured.finite && std::isfinite(score);
    if (piece.cycles == mission.cycles) {
      measured.least = measured.runs == 0 ? score : std::min(measured.least, score);
      measured.most = measured.runs == 0 ? score : std::max(measured.most, score);
      ++measured.runs;
    }
    const double run_s = processor_s() - begin;
    elapsed_s += run_s;
    if (runs == 0 && piece.cycles < mission.cycles && kGrowth * run_s < budget_s - elapsed_s) {
      piece.cycles = std::min(mission.cycles, kGrowth * piece.cycles);
      continue;
    }
    counted_s += run_s;
    ++runs;
  }
  if (runs == 0) return measured;
  measured.evaluation_s = counted_s / static_cast<double>(runs) * mission.cycles / piece.cycles;
  return measured;
}

}  // namespace

CampaignPlan plan_of(const Campaign& campaign) {
  CampaignPlan plan;
  const auto methods = static_cast<std::int64_t>(campaign.methods.size());
  const auto missions = static_cast<std::int64_t>(campaign.missions.size());
  for (const DesignRow& design : design_rows(campaign)) {
    ++plan.designs;
    plan.experiments += design.budget;
    plan.largest_budget = std::max(plan.largest_budget, design.budget);
  }
  std::int64_t tested = 0;  // machines per mission
  for (const Method& method : campaign.methods) {
    const std::int64_t elites = method.baseline.empty() ? campaign.test_nb_elites : 1;
    tested += elites * repetitions_of(campaign, method);
  }
  const auto worlds = static_cast<std::int64_t>(1 + campaign.test_profiles.size());
  for (const CampaignMission& mission : campaign.missions)
    plan.tests += mission.test_count * tested * worlds;
  const std::int64_t cores = usable_processors();
  plan.slots = std::max<std::int64_t>(1, campaign.local_workers.value_or(cores));
  const auto evaluations = static_cast<double>(plan.experiments + plan.tests);
  plan.disk_bytes = evaluations * kBytesPerEvaluation;
  plan.log_bytes = std::min(kLargestLog, evaluations * kLogBytesPerEvaluation);
  plan.warnings = warnings_about(campaign);
  // The running time of programs is not known in advance.
  if (campaign.target) return plan;
  const auto pairs = static_cast<double>(missions * methods);
  double sum_s = 0;
  for (const CampaignMission& mission : campaign.missions) {
    for (const Method& method : campaign.methods) {
      const RandomRuns measured = measure(campaign, method, mission.mission, kMeasured_s / pairs);
      sum_s += measured.evaluation_s;
      warn_about_scores(mission.mission.name, measured, plan.warnings);
    }
  }
  plan.evaluation_s = sum_s / pairs;
  const auto busy = static_cast<double>(std::min(plan.slots, cores));
  plan.time_s = evaluations * (*plan.evaluation_s + kOverhead_s) / busy;
  return plan;
}

}  // namespace swarmsmith::cli
