#pragma once

namespace swarmsmith {

/// Raises this process's limit of open files and connections, as far as the system allows: the
/// usual 1,024 are too few for a cluster.
void raise_descriptor_limit(int wanted);

}  // namespace swarmsmith
