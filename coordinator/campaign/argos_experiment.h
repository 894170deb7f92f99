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
  Profile profile;        ///< for e-pucks: the file contains its noise
  std::int64_t seed = 1;  ///< 1 to 4294967295: for 0, ARGoS uses the time of day
  std::string title;      ///< for the comment at the start of the file
};

/// An experiment file (.argos, XML) for ARGoS 3.0.0-beta48.
///
/// For the RVR, the file is for the programs published with the thesis: the RVR plugin, the loop
/// functions of the missions, and AutoMoDe (rvr-automode facts, sections 6.3 to 8 and the table of
/// versions). The machine is written with the module numbers of that AutoMoDe.
///
/// For other robots, it is for the e-puck's software stack, like the published files of
/// Results-Transferability (epuck facts, section 6.1; repositories E, D, L, M).
///
/// Libraries are named without folders, so that ARGoS finds them through ARGOS_PLUGIN_PATH.
///
/// Errors: BadInput if the original software has no loop functions for the mission, or if its
/// AutoMoDe lacks a module or the architecture. The mission may differ from the original in name,
/// duration and number of robots (at most 9 RVRs), and for e-pucks in light and radio range.
Expected<std::string> argos_experiment(const ArgosExperiment& experiment);

/// Keys of a profile that an experiment file for e-pucks cannot express, such as "timing.delays".
/// It can express the noise of wheels and of proximity, light and ground sensors, and packet loss.
std::vector<std::string> left_out_of_argos(const Profile& profile);

}  // namespace swarmsmith
