#pragma once

#include "console/output.h"

namespace swarmsmith::cli {

/// irace's --init: writes templates of all files into the current folder, but none over a file that
/// is there.
ExitCode write_templates(Output& output);

}  // namespace swarmsmith::cli
