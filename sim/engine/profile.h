#pragma once

#include <string>
#include <string_view>

#include "base/expected.h"

namespace swarmsmith {

/// Who solves contacts between robots and with walls; each checks the other.
enum class ContactModel {
  Exact,  ///< our own, for square robots in a convex arena; elsewhere Box2D takes over
  Box2d,
};

/// How the simulated robot's sensors and actuators fall short of ideal ones: data, one struct a
/// device. Standard deviations and half-widths in the reading's unit.
struct Profile {
  std::string name;
  double proximity_range_m = 0.4;  ///< R: beyond it a reading is +infinity
  double proximity_sd_m = 0;       ///< normal noise on finite distances (thesis 4.2.9)
  double ground_color_sd = 0;      ///< normal noise a channel, rounded, clamped (thesis 4.2.1)
  ContactModel contacts = ContactModel::Exact;

  friend bool operator==(const Profile&, const Profile&) = default;
};

/// `rvr` (thesis 4.2: noise on) or `argos3` (as the published files: noise off). An unknown name is
/// an error that lists the known ones.
Expected<Profile> built_in_profile(std::string_view name);

}  // namespace swarmsmith
