#pragma once

#include <string>

#include "base/expected.h"
#include "coordinator/campaign/argos_experiment.h"
#include "sim/control/controller.h"
#include "sim/control/flavour.h"

namespace swarmsmith {

/// Elements of an experiment file that the stacks of both robots use.

/// The seed and the duration.
std::string argos_framework(const ArgosExperiment& experiment);

/// The twelve walls of the thesis' dodecagonal arena, which the e-puck's missions use too (epuck
/// facts, section 6.1).
std::string argos_walls();

/// The experiment file for the e-puck's stack. Errors: BadInput.
Expected<std::string> argos_experiment_of_epucks(const ArgosExperiment& experiment);

/// Fails if the original AutoMoDe, whose modules `flavour` contains, cannot run this.
Expected<void> check_for_argos(const Controller& controller, const Flavour& flavour);

/// Makes a text safe for an XML comment, which must not contain two hyphens in a row.
std::string argos_comment(std::string_view text);

}  // namespace swarmsmith
