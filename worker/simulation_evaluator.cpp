#include "worker/simulation_evaluator.h"

#include <algorithm>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/assert.h"
#include "sim/control/controller.h"
#include "sim/control/flavour.h"
#include "sim/engine/simulate.h"

namespace swarmsmith {
namespace {

/// Candidates are evaluated on many pairs, so parsed control software is cached; the cache is
/// limited, because races can be long.
constexpr std::size_t kMaxControllers = 1024;

class Simulation {
 public:
  Simulation(WorkerScenario scenario, std::vector<Flavour> flavours)
      : scenario_(std::move(scenario)),
        flavours_(std::move(flavours)),
        controllers_(flavours_.size()) {
    SWARMSMITH_ASSERT(flavours_.size() == scenario_.methods.size(), "each method has its flavour");
  }

  Result operator()(const LeasedTask& item) {
    Expected<Result> result = simulate_item(item);
    if (!result) return {.failure = to_string(result.error())};
    return std::move(*result);
  }

 private:
  Expected<Result> simulate_item(const LeasedTask& item) {
    // A task comes from outside; numbers that do not exist are a failure of the task, not of this
    // process.
    if (item.mission >= scenario_.missions.size() || item.method >= flavours_.size()) {
      return bad_input("a task for a mission or method that the scenario does not have");
    }
    if (item.profile > scenario_.test_profiles.size()) {
      return bad_input("a task for a profile that the scenario does not have");
    }
    const Mission& mission = scenario_.missions[item.mission];
    const Flavour& flavour = flavours_[item.method];
    const Expected<const Controller*> controller = controller_of(item);
    if (!controller) return Unexpected(controller.error());
    // The seed alone determines the instance, so all workers simulate the same one.
    const Expected<Instance> instance = instance_of(mission, item.seed);
    if (!instance) return Unexpected(instance.error());
    return Result{.measured = simulate({.controller = **controller,
                                        .flavour = flavour,
                                        .profile = profile_of(item),
                                        .mission = mission,
                                        .instance = *instance,
                                        .seed = item.seed})};
  }

  /// 0 is the profile of the campaign; the others are those of repeated tests.
  const Profile& profile_of(const LeasedTask& item) const {
    return item.profile == 0 ? scenario_.profile : scenario_.test_profiles[item.profile - 1];
  }

  Expected<const Controller*> controller_of(const LeasedTask& item) {
    // By method, because the same text may mean other control software in another flavour.
    auto& known = controllers_[item.method];
    if (const auto at = known.find(item.machine); at != known.end()) return &at->second;
    Expected<Controller> controller = parse_controller(item.machine, flavours_[item.method]);
    if (!controller) return Unexpected(controller.error());
    if (const auto complaint = complaint_about_running(*controller, flavours_[item.method]))
      return bad_input(*complaint);
    // All of them: a race goes on with the candidates that are alive, and parses them once more.
    if (known.size() >= kMaxControllers) known.clear();
    return &known.emplace(item.machine, std::move(*controller)).first->second;
  }

  WorkerScenario scenario_;
  std::vector<Flavour> flavours_;                                         ///< by method
  std::vector<std::unordered_map<std::string, Controller>> controllers_;  ///< by method and text
};

/// The engine version that is needed to simulate all of its missions here.
int engine_version_of(const WorkerScenario& scenario) {
  int version = kEngineVersion;
  for (const Mission& mission : scenario.missions) {
    version = std::max(version, engine_version_of(mission, scenario.profile));
    for (const Profile& profile : scenario.test_profiles)
      version = std::max(version, engine_version_of(mission, profile));
  }
  return version;
}

}  // namespace

Expected<Evaluator> make_simulation_evaluator(WorkerScenario scenario) {
  // Another version may give other bits. One score of it would make the campaign's answer depend on
  // which worker was faster.
  if (const int own = engine_version_of(scenario); scenario.engine_version != own) {
    return unexpected(ErrorKind::Conflict,
                      "the campaign needs version " + std::to_string(scenario.engine_version) +
                          " of the simulator, this program has version " + std::to_string(own));
  }
  std::vector<Flavour> flavours;
  for (const WorkerMethod& method : scenario.methods) {
    Expected<Flavour> flavour = find_flavour(method.flavour, method.turn_clock, method.own_flavour);
    if (!flavour) return Unexpected(flavour.error());
    flavours.push_back(std::move(*flavour));
  }
  return Evaluator(Simulation(std::move(scenario), std::move(flavours)));
}

}  // namespace swarmsmith
