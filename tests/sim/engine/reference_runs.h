#pragma once

#include <string>
#include <vector>

#include "sim/control/controller.h"
#include "sim/control/flavour.h"
#include "sim/engine/simulate.h"
#include "sim/mission/mission.h"
#include "tests/sim/engine/reference_data.h"

namespace swarmsmith {

/// A mission with the original's instances and everything else that a run needs, so that a test can
/// name a machine and a seed. Flavour and profile are those of the original, unless changed.
struct ReferenceRuns {
  explicit ReferenceRuns(const char* mission_name);

  /// `seed` (1..100) gives starts and patches; `stream` more control draws for the same instance.
  Measured run(const Controller& controller, int seed, int stream = 0,
               const Recorder& recorder = {}) const;

  Mission mission;
  std::vector<Instance> instances;
  const Flavour* flavour;
  Profile profile;
};

/// A machine of the reference data in the flavour of the original.
Machine machine_of(const std::string& text, const Flavour& flavour = watermelon_argos3());

}  // namespace swarmsmith
