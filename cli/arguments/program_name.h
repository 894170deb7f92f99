#pragma once

#include <string>

namespace swarmsmith::cli {

/// "swarmsmith 0.1.0 (engine 2)": the program named in the files that it makes.
std::string program_name();

}  // namespace swarmsmith::cli
