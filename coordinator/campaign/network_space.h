#pragma once

#include "base/expected.h"
#include "coordinator/campaign/campaign.h"
#include "irace_core/configuration.h"
#include "irace_core/parameter_space.h"
#include "sim/control/network.h"

namespace swarmsmith {

/// The weights of a method's networks, all real and always active: w1 is the left wheel's first.
Expected<ParameterSpace> network_space(const Method& method, int digits);

/// The network of a configuration of the space of `network_space`.
Network to_network(const Method& method, const Configuration& configuration);

}  // namespace swarmsmith
