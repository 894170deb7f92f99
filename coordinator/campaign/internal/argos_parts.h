#pragma once

#include <string>

#include "base/expected.h"
#include "coordinator/campaign/argos_experiment.h"
#include "sim/control/controller.h"
#include "sim/control/flavour.h"

namespace swarmsmith {

/// Elements of an experiment file that both stacks have.

/// Seed and duration.
std::string argos_framework(const ArgosExperiment& experiment);

/// The twelve walls of the thesis' dodecagon, which is that of the e-puck's missions, too (epuck
/// facts, section 6.1).
std::string argos_walls();

/// The file for the e-puck's stack. Errors: BadInput.
Expected<std::string> argos_experiment_of_epucks(const ArgosExperiment& experiment);

/// Errors: what the original AutoMoDe cannot run, of the flavour that has its modules.
Expected<void> check_for_argos(const Controller& controller, const Flavour& flavour);

/// For a comment of XML, where two hyphens must not meet.
std::string argos_comment(std::string_view text);

}  // namespace swarmsmith
