#pragma once

#include <string>

#include "base/expected.h"
#include "coordinator/campaign/argos_experiment.h"

namespace swarmsmith {

/// Elements of an experiment file that both stacks have.

/// Seed and duration.
std::string argos_framework(const ArgosExperiment& experiment);

/// The twelve walls of the thesis' dodecagon, which is that of the e-puck's missions, too (epuck
/// facts, section 6.1).
std::string argos_walls();

/// The file for the e-puck's stack. Errors: BadInput.
Expected<std::string> argos_experiment_of_epucks(const ArgosExperiment& experiment);

/// For a comment of XML, where two hyphens must not meet.
std::string argos_comment(std::string_view text);

}  // namespace swarmsmith
