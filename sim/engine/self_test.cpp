#include "sim/engine/self_test.h"

#include <array>

#include "base/assert.h"
#include "base/hash.h"
#include "sim/control/machine_text.h"
#include "sim/engine/simulate.h"

namespace swarmsmith {
namespace {

/// Every device falls short in every way, so that each draw and each branch leaves its trace.
Profile every_noise(ContactModel contacts, NeighbourSensing::Source neighbours) {
  return {.name = "every-noise",
          .contacts = contacts,
          .proximity = {.range_m = 0.4,
                        .sd_m = 0.01,
                        .scale_sd = 0.1,
                        .largest_miss_rate = 0.2,
                        .phantom_rate = 0.005},
          .ground_color = {.sd = 5, .bias_sd = 10, .labeler = true},
          .lidar = {.half_width_m = 0.01},
          .neighbours = {.source = neighbours,
                         .miss_rate = 0.05,
                         .weak_share = 0.2,
                         .weak_miss_rate = 0.5},
          .timing = {.delays = {{10, 0.25}, {20, 0.5}, {30, 0.25}},
                     .least_period = 0.75,
                     .most_period = 1.0,
                     .jitter = 0.05},
          .tracking = {.tag = {-0.072, 0}, .scores_tag = true}};
}

}  // namespace

std::string self_test_digest() {
  // Explores, joins neighbours, stops on black: treads, rays, contacts, floor and draws.
  static constexpr const char* kMachine =
      "--nstates 3 --s0 0 --rwm0 30 --n0 2 --n0x0 0 --c0x0 3 --p0x0 1 --w0x0 5 --n0x1 1 --c0x1 0 "
      "--p0x1 1 --s1 2 --att1 5 --n1 2 --n1x0 0 --c1x0 5 --p1x0 0.05 --n1x1 1 --c1x1 0 --p1x1 1 "
      "--s2 1 --n2 1 --n2x0 0 --c2x0 1 --p2x0 0.5";
  using Source = NeighbourSensing::Source;
  // Box2D too: a worker may have another build of it.
  const std::array profiles = {Profile{.name = "ideal"},
                               Profile{.name = "box2d", .contacts = ContactModel::Box2d},
                               every_noise(ContactModel::Exact, Source::Camera),
                               every_noise(ContactModel::Box2d, Source::Lidar)};
  Digest digest;
  for (const char* name : {"aggregation", "grid_exploration", "color_selection"}) {
    for (const Profile& profile : profiles) {
      Expected<Mission> mission = built_in_mission(name);
      const Expected<Machine> machine = parse_machine(kMachine, watermelon());
      SWARMSMITH_ASSERT(mission && machine, "the self test uses what is built in");
      mission->cycles = 200;
      const Expected<Instance> instance = instance_of(*mission, 1);
      SWARMSMITH_ASSERT(instance.has_value(), "three robots fit into the arena");
      const SimulationResult result = simulate({.controller = *machine,
                                                .flavour = watermelon(),
                                                .profile = profile,
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
