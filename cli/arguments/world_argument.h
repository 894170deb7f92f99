#pragma once

#include <string>

#include "base/expected.h"
#include "console/output.h"
#include "sim/control/flavour.h"
#include "sim/engine/profile.h"
#include "sim/mission/mission.h"

namespace swarmsmith::cli {

/// The mission, profile, flavour or robot of a flag: built in, or a file. All that is wrong with a
/// file but the last thing is printed, the last is the error; `flag` is where, when the file has no
/// place for it.
Expected<Mission> find_mission_or_complain(const std::string& word, const std::string& flag,
                                           Output& output);
Expected<Profile> find_profile_or_complain(const std::string& word, const std::string& flag,
                                           Output& output);
Expected<Flavour> find_flavour_or_complain(const std::string& word, const std::string& flag,
                                           Output& output);
Expected<Robot> find_robot_or_complain(const std::string& word, const std::string& flag,
                                       Output& output);

}  // namespace swarmsmith::cli
