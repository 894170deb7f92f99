#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/expected.h"
#include "sim/control/machine.h"
#include "sim/mission/mission.h"

namespace swarmsmith {

struct ArgosExperiment {
  Machine machine;
  Mission mission;
  std::int64_t seed = 1;  ///< 1 to 4294967295: ARGoS takes 0 for the time of day
  std::string title;      ///< for the comment at the file's head
};

/// An experiment file (.argos, XML) of the programs published with the thesis: ARGoS 3.0.0-beta48
/// with its RVR plugin, the missions' loop functions and AutoMoDe (rvr-automode facts, sections 6.3
/// to 8 and the table of versions). The machine is written with that AutoMoDe's numbers. Libraries
/// are named without folders, and found through ARGOS_PLUGIN_PATH.
///
/// Errors: BadInput when the mission is none of the thesis' three, apart from its name, duration
/// and number of robots (up to 9), or the machine has a module that AutoMoDe lacks.
Expected<std::string> argos_experiment(const ArgosExperiment& experiment);

}  // namespace swarmsmith
