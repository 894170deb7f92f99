#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/expected.h"
#include "sim/control/controller.h"
#include "sim/engine/profile.h"
#include "sim/mission/mission.h"

namespace swarmsmith {

struct ArgosExperiment {
  Controller controller;
  Mission mission;
  Profile profile;        ///< of e-pucks: its noise is in the file
  std::int64_t seed = 1;  ///< 1 to 4294967295: ARGoS takes 0 for the time of day
  std::string title;      ///< for the comment at the file's head
};

/// An experiment file (.argos, XML) for ARGoS 3.0.0-beta48.
///
/// Of the RVR: for the programs published with the thesis, the RVR plugin, the missions' loop
/// functions and AutoMoDe (rvr-automode facts, sections 6.3 to 8 and the table of versions). The
/// machine is written with that AutoMoDe's numbers.
///
/// Of another robot: for the e-puck's stack, as in the published files of Results-Transferability
/// (epuck facts, section 6.1; repositories E, D, L, M).
///
/// Libraries are named without folders, and found through ARGOS_PLUGIN_PATH.
///
/// Errors: BadInput when the original has no loop functions for the mission, or its AutoMoDe lacks
/// a module or the architecture. A mission may have another name, duration and number of robots (of
/// RVRs up to 9), e-pucks' ones another light and range of the radio.
Expected<std::string> argos_experiment(const ArgosExperiment& experiment);

/// Keys of a profile that an experiment file of e-pucks cannot say, "timing.delays": it has the
/// noise of wheels, proximity, light and ground, and the share of lost packets.
std::vector<std::string> left_out_of_argos(const Profile& profile);

}  // namespace swarmsmith
