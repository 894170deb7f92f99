#pragma once

#include <span>
#include <vector>

#include "base/rng.h"
#include "sim/control/module.h"
#include "sim/control/modules.h"
#include "sim/control/reference_model.h"

namespace swarmsmith {

/// Low-level behaviours, one a state of the machine: a file each in sim/control/behaviours. What
/// they do in detail is the flavour's data; the sources are thesis facts, section 6, and
/// rvr-automode facts, section 5.

Module module_of(const Behaviour& behaviour);

/// The parameters' values, in the order of the flavour's table.
std::vector<double> parameters_of(const Behaviour& behaviour);

/// The inverse of the two above. Throws std::invalid_argument when `module` is not a behaviour or
/// the number of parameters is another.
Behaviour make_behaviour(Module module, std::span<const double> parameters);

/// One control cycle of a behaviour. Asks `senses` only for what it needs: a turning or a standing
/// robot asks for nothing.
Command act(const Behaviour& behaviour, Senses& senses, const Flavour& flavour,
            BehaviourMemory& memory, Rng& rng);

/// What the behaviour may ask for in some cycle or other, without the time.
UsedSenses senses_used_by(const Behaviour& behaviour, const Flavour& flavour);

}  // namespace swarmsmith
