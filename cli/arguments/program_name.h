#pragma once

#include <string>

namespace swarmsmith::cli {

/// "swarmsmith 0.1.0 (engine 2)": what made a file.
std::string program_name();

}  // namespace swarmsmith::cli
