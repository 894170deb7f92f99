#pragma once

#include <cstdint>
#include <string>

#include "base/expected.h"

namespace swarmsmith {

/// Raises this process's limit on open files and connections as far as the system allows: the usual
/// 1,024 are too few for a cluster. Unavailable when fewer than `needed` can be opened in addition
/// to the open ones: libraries would then end the process, or wait forever. `who` is the user of
/// the descriptors, for the message: "a campaign with 2 workers".
Expected<void> provide_descriptors(std::int64_t needed, std::int64_t wanted,
                                   const std::string& who);

/// Unavailable when the address space (`ulimit -v`) is smaller than `bytes`, which include the
/// memory that this process has already; or when its control groups allow less memory than
/// `memory`. Libraries end the process when they get no memory.
Expected<void> check_memory(std::uint64_t bytes, std::uint64_t memory, const std::string& who);

}  // namespace swarmsmith
