#pragma once

#include <chrono>
#include <string>

#include "base/expected.h"
#include "coordinator/live_status.h"

namespace swarmsmith::cli {

/// The status of a running coordinator as JSON, asked over the wire. `endpoint` is tcp://HOST:PORT.
/// Errors: Unavailable (nobody answers in time), BadInput (it does not let this program read).
Expected<std::string> ask_status(const std::string& endpoint, std::chrono::milliseconds patience);

}  // namespace swarmsmith::cli
