#pragma once

#include <span>
#include <vector>

#include "base/rng.h"
#include "sim/control/module.h"
#include "sim/control/modules.h"
#include "sim/control/reference_model.h"

namespace swarmsmith {

/// Low-level behaviours; each state of a machine has one. Each is defined in its own file in
/// sim/control/behaviours. Their constants are part of the flavour; the sources are thesis facts,
/// section 6, and rvr-automode facts, section 5.

Module module_of(const Behaviour& behaviour);

/// The values of the parameters, in the order of the flavour's table.
std::vector<double> parameters_of(const Behaviour& behaviour);

/// The inverse of the two functions above. Throws std::invalid_argument when `module` is not a
/// behaviour or takes a different number of parameters.
Behaviour make_behaviour(Module module, std::span<const double> parameters);

/// Runs one control cycle of a behaviour. It requests from `senses` only the readings that it
/// needs: a robot that turns or stands still requests none.
Command act(const Behaviour& behaviour, Senses& senses, const Flavour& flavour,
            BehaviourMemory& memory, Rng& rng);

/// The readings that the behaviour may request in any cycle, except the time.
UsedSenses senses_used_by(const Behaviour& behaviour, const Flavour& flavour);

}  // namespace swarmsmith
