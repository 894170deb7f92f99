#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "base/expected.h"
#include "console/output.h"

namespace swarmsmith::cli {

/// Reads the tables of an irace log from a folder; the keys are their names (irace_log_files).
/// Leaves out missing tables.
std::map<std::string, std::string> read_log_folder(const std::filesystem::path& folder);

/// Converts irace.Rdata with R, by a script that is built into this program. Errors: Unavailable if
/// there is no Rscript, BadInput if R refuses the file.
Expected<std::map<std::string, std::string>> convert_irace_log(const std::filesystem::path& log,
                                                               Output& output);

/// Makes the bytes of an irace.Rdata from the tables. Errors: Unavailable if there is no Rscript,
/// or if R refuses the tables; `log` is the name in messages.
Expected<std::string> make_irace_log(const std::map<std::string, std::string>& tables,
                                     const std::filesystem::path& log, Output& output);

}  // namespace swarmsmith::cli
