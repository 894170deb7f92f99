#pragma once

#include <chrono>
#include <string>

#include "base/expected.h"
#include "proto/access/find_coordinator.h"

namespace swarmsmith::cli {

/// The status of a running coordinator as JSON, asked over the wire. Errors: Unavailable (no answer
/// in time), BadInput (this program may not read).
Expected<std::string> ask_status(const FoundCoordinator& coordinator,
                                 std::chrono::milliseconds patience);

}  // namespace swarmsmith::cli
