#pragma once

namespace swarmsmith {

/// Lets this process have so many open files and connections, as far as the system allows: the
/// usual limit of 1,024 is short for a cluster's.
void raise_descriptor_limit(int wanted);

}  // namespace swarmsmith
