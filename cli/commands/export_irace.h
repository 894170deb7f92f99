#pragma once

#include <string>

#include "console/exit_code.h"
#include "console/output.h"

namespace swarmsmith::cli {

/// Arguments of `export --format irace`.
struct IraceExport {
  std::string design;         ///< d3; empty: the first, when there is no choice
  std::string version = "4";  ///< or 3.5
};

/// Writes a folder in which irace does a design of `source`, a campaign file or a store. The folder
/// is made; files that are there already are not overwritten.
ExitCode export_irace(const std::string& source, const IraceExport& what, const std::string& folder,
                      Output& output);

}  // namespace swarmsmith::cli
