#pragma once

#include <cstdint>
#include <string>

#include "base/expected.h"

namespace swarmsmith {

/// Raises this process's limit of open files and connections, as far as the system allows: the
/// usual 1,024 are too few for a cluster. Unavailable when fewer than `needed` can be opened beside
/// those that are open: libraries end the process then, or wait for ever. `who` needs them: "a
/// campaign with 2 workers".
Expected<void> provide_descriptors(std::int64_t needed, std::int64_t wanted,
                                   const std::string& who);

/// Unavailable when the address space (`ulimit -v`) is too small for `bytes`, what this process has
/// already included; or when its control groups grant less memory than `memory`. Without memory,
/// libraries end the process.
Expected<void> check_memory(std::uint64_t bytes, std::uint64_t memory, const std::string& who);

}  // namespace swarmsmith
