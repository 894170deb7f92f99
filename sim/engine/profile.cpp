#include "sim/engine/profile.h"

#include <array>
#include <string>

namespace swarmsmith {

Expected<Profile> built_in_profile(std::string_view name) {
  // The thesis gives 5 for the ground colour and a picture for proximity: 0.01 m is our reading of
  // "small" (thesis facts, section 3).
  static const std::array<Profile, 2> kProfiles = {
      Profile{.name = "rvr", .proximity_sd_m = 0.01, .ground_color_sd = 5},
      Profile{.name = "argos3"},
  };
  std::string known;
  for (const Profile& profile : kProfiles) {
    if (profile.name == name) return profile;
    known += known.empty() ? profile.name : ", " + profile.name;
  }
  return unexpected(ErrorKind::NotFound,
                    "no simulator profile '" + std::string(name) + "'; known: " + known);
}

}  // namespace swarmsmith
