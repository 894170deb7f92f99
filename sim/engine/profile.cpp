#include "sim/engine/profile.h"

#include <array>
#include <string>

namespace swarmsmith {
namespace {

// The thesis gives 5 for the ground colour, 200 ms for the latency and pictures for the rest; the
// other numbers are our readings of it (thesis facts, sections 3 and 13).

Profile rvr() {
  return {.name = "rvr",
          .proximity = {.sd_m = 0.01},
          .ground_color = {.sd = 5},
          .lidar = {.half_width_m = 0.01}};
}

Profile pseudo_reality() {
  return {
      .name = "pseudo-reality",
      .proximity = {.sd_m = 0.01, .scale_sd = 0.1, .largest_miss_rate = 0.2, .phantom_rate = 0.005},
      .ground_color = {.sd = 5, .bias_sd = 10, .labeler = true},
      .lidar = {.half_width_m = 0.01},
      .neighbours = {.miss_rate = 0.05, .weak_share = 0.2, .weak_miss_rate = 0.5},
      .timing = {.delays = {{10, 0.25}, {20, 0.5}, {30, 0.25}},
                 .least_period = 0.75,
                 .most_period = 1.0,
                 .jitter = 0.05},
      .tracking = {.tag = {-0.072, 0}}};
}

}  // namespace

std::vector<Rgb> GroundColorSensing::default_labels() {
  std::vector<Rgb> labels;
  for (const NamedColor& named : kNamedColors)
    labels.push_back(named.color);
  return labels;
}

Expected<Profile> built_in_profile(std::string_view name) {
  static const std::array<Profile, 3> kProfiles = {rvr(), Profile{.name = "argos3"},
                                                   pseudo_reality()};
  std::string known;
  for (const Profile& profile : kProfiles) {
    if (profile.name == name) return profile;
    known += known.empty() ? profile.name : ", " + profile.name;
  }
  return unexpected(ErrorKind::NotFound,
                    "no simulator profile '" + std::string(name) + "'; known: " + known);
}

}  // namespace swarmsmith
