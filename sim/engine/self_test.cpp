#include "sim/engine/self_test.h"

#include "base/hash.h"
#include "sim/control/machine_text.h"
#include "sim/engine/simulate.h"

namespace swarmsmith {

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
