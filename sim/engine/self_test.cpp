#include "sim/engine/self_test.h"

#include <array>

#include "base/assert.h"
#include "base/hash.h"
#include "sim/engine/simulate.h"

namespace swarmsmith {
namespace {

/// Every device has every kind of error, so that each draw and each branch affects the result.
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

/// Explores, joins neighbours, stops on black: covers treads, rays, contacts, floor and draws.
constexpr const char* kMachine =
    "--nstates 3 --s0 0 --rwm0 30 --n0 2 --n0x0 0 --c0x0 3 --p0x0 1 --w0x0 5 --n0x1 1 --c0x1 0 "
    "--p0x1 1 --s1 2 --att1 5 --n1 2 --n1x0 0 --c1x0 5 --p1x0 0.05 --n1x1 1 --c1x1 0 --p1x1 1 "
    "--s2 1 --n2 1 --n2x0 0 --c2x0 1 --p2x0 0.5";

/// Explores until neighbours are near, joins them for a while, explores until black: covers
/// conditions that draw, and actions that keep their turn.
constexpr const char* kTree =
    "--nroot 3 --nchildroot 3 --n0 0 --nchild0 2 --n00 6 --c00 3 --p00 1 --w00 5 --n01 5 --a01 0 "
    "--rwm01 30 --p01 0 --n1 0 --nchild1 2 --n10 6 --c10 5 --p10 0.05 --n11 5 --a11 2 --att11 5 "
    "--p11 0 --n2 0 --nchild2 2 --n20 6 --c20 0 --p20 0.5 --n21 5 --a21 0 --rwm21 10 --p21 0";

/// Fast on an empty floor, turns away from near obstacles; every input has a weight.
constexpr const char* kNetwork =
    "--network rvr --weights 0.71,-0.35,-0.2,0.64,-0.12,0.23,0.08,0.31,0.45,0.11,-0.27,-0.38,0.42,"
    "-0.66,-0.4,-0.15,-0.93,0.17,-0.09,0.21,-0.26,0.13,0.52,0.34,-0.19,0.37";

const char* text_of(Architecture architecture) {
  switch (architecture) {
    case Architecture::Machine:
      return kMachine;
    case Architecture::Tree:
      return kTree;
    case Architecture::Network:
      break;
  }
  return kNetwork;
}

}  // namespace

std::string self_test_digest(Architecture architecture) {
  const Expected<Controller> controller = parse_controller(text_of(architecture), watermelon());
  SWARMSMITH_ASSERT(controller.has_value(), "the self test's texts are well-formed");
  using Source = NeighbourSensing::Source;
  // Box2D, too: a worker may have another build of it.
  const std::array profiles = {Profile{.name = "ideal"},
                               Profile{.name = "box2d", .contacts = ContactModel::Box2d},
                               every_noise(ContactModel::Exact, Source::Camera),
                               every_noise(ContactModel::Box2d, Source::Lidar)};
  Digest digest;
  for (const char* name : {"aggregation", "grid_exploration", "color_selection"}) {
    for (const Profile& profile : profiles) {
      Expected<Mission> mission = built_in_mission(name);
      SWARMSMITH_ASSERT(mission.has_value(), "the self test uses what is built in");
      mission->cycles = 200;
      const Expected<Instance> instance = instance_of(*mission, 1);
      SWARMSMITH_ASSERT(instance.has_value(), "three robots fit into the arena");
      const Measured result = simulate({.controller = *controller,
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

std::string self_test_digest() {
  Digest digest;
  for (const Architecture architecture :
       {Architecture::Machine, Architecture::Tree, Architecture::Network})
    digest.add(self_test_digest(architecture));
  return digest.hex();
}

}  // namespace swarmsmith
