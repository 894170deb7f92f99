#pragma once

#include <string>

namespace swarmsmith::cli {

/// "swarmsmith 0.1.0 (engine 2)": the name of this program in the files that it writes.
std::string program_name();

}  // namespace swarmsmith::cli
