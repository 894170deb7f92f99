#pragma once

#include <string>

#include "base/expected.h"
#include "console/output.h"
#include "sim/control/flavour.h"
#include "sim/engine/profile.h"
#include "sim/mission/mission.h"

namespace swarmsmith::cli {

/// Finds the mission, profile, flavour or robot that a flag names: a built-in one, or a file.
/// Prints all errors of a file except the last one, which is returned. An error without a place in
/// the file gets `flag` as its place.
Expected<Mission> find_mission_or_complain(const std::string& word, const std::string& flag,
                                           Output& output);
Expected<Profile> find_profile_or_complain(const std::string& word, const std::string& flag,
                                           Output& output);
Expected<Flavour> find_flavour_or_complain(const std::string& word, const std::string& flag,
                                           Output& output);
Expected<Robot> find_robot_or_complain(const std::string& word, const std::string& flag,
                                       Output& output);

}  // namespace swarmsmith::cli
