#include "worker/evaluate.h"

#include <unordered_map>
#include <utility>
#include <vector>

#include "base/hash.h"
#include "sim/control/flavour.h"
#include "sim/control/machine_text.h"
#include "sim/engine/simulate.h"
#include "sim/messages/scenario_messages.h"

namespace swarmsmith {
namespace {

/// Candidates meet many pairs, so that their machines come again; bounded, since races go on.
constexpr std::size_t kMaxMachines = 1024;

class Simulation {
 public:
  Simulation(WorkerScenario scenario, std::vector<const Flavour*> flavours)
      : scenario_(std::move(scenario)), flavours_(std::move(flavours)), machines_(flavours_.size()) {}

  Expected<Measured> operator()(const WorkItem& item) {
    if (item.mission >= scenario_.missions.size() || item.method >= flavours_.size()) {
      return bad_input("a task for a mission or method that the scenario does not have");
    }
    const Mission& mission = scenario_.missions[item.mission];
    const Flavour& flavour = *flavours_[item.method];
    const Expected<const Machine*> machine = machine_of(item);
    if (!machine) return Unexpected(machine.error());
    const Expected<Instance> instance = instance_of(mission, item.seed);
    if (!instance) return Unexpected(instance.error());
    const SimulationResult result = simulate({.machine = **machine,
                                              .flavour = flavour,
                                              .profile = scenario_.profile,
                                              .mission = mission,
                                              .instance = *instance,
                                              .seed = item.seed});
    return Measured{result.score, result.state_digest};
  }

 private:
  Expected<const Machine*> machine_of(const WorkItem& item) {
    auto& known = machines_[item.method];
    if (const auto at = known.find(item.machine); at != known.end()) return &at->second;
    Expected<Machine> machine = parse_machine(item.machine, *flavours_[item.method]);
    if (!machine) return Unexpected(machine.error());
    if (known.size() >= kMaxMachines) known.clear();
    return &known.emplace(item.machine, std::move(*machine)).first->second;
  }

  WorkerScenario scenario_;
  std::vector<const Flavour*> flavours_;
  std::vector<std::unordered_map<std::string, Machine>> machines_;  ///< by method and text
};

}  // namespace

Expected<Evaluator> make_simulation(const std::string& scenario) {
  Expected<WorkerScenario> read = scenario_from_bytes(scenario);
  if (!read) return Unexpected(read.error());
  if (read->engine_version != kEngineVersion) {
    return unexpected(ErrorKind::Conflict,
                      "the campaign wants version " + std::to_string(read->engine_version) +
                          " of the simulator, this program has version " +
                          std::to_string(kEngineVersion));
  }
  std::vector<const Flavour*> flavours;
  for (const std::string& name : read->flavours) {
    const Expected<const Flavour*> flavour = find_flavour(name);
    if (!flavour) return Unexpected(flavour.error());
    flavours.push_back(*flavour);
  }
  return Evaluator(Simulation(std::move(*read), std::move(flavours)));
}

std::string self_test_digest() {
  // Explores, and turns to attraction when it sees neighbours: treads, rays, contacts and draws.
  static constexpr const char* kMachine =
      "--nstates 2 --s0 0 --rwm0 20 --n0 1 --n0x0 0 --c0x0 3 --w0x0 5 --p0x0 3 "
      "--s1 4 --att1 3 --n1 1 --n1x0 0 --c1x0 5 --p1x0 0.3";
  Digest digest;
  for (const char* name : {"aggregation", "grid_exploration", "color_selection"}) {
    for (const char* profile_name : {"rvr", "argos3"}) {
      Expected<Mission> mission = built_in_mission(name);
      const Expected<Profile> profile = built_in_profile(profile_name);
      const Expected<Machine> machine = parse_machine(kMachine, watermelon());
      if (!mission || !profile || !machine) return "broken";
      mission->cycles = 200;
      const Expected<Instance> instance = instance_of(*mission, 1);
      if (!instance) return "broken";
      const SimulationResult result = simulate({.machine = *machine,
                                                .flavour = watermelon(),
                                                .profile = *profile,
                                                .mission = *mission,
                                                .instance = *instance,
                                                .seed = 1});
      digest.add(result.score);
      digest.add(result.state_digest);
    }
  }
  return digest.hex();
}

}  // namespace swarmsmith
