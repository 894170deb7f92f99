#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "base/expected.h"
#include "console/output.h"

namespace swarmsmith::cli {

/// The tables of a log of irace, by their names (irace_log_files): of a folder in which they are.
/// A table that is not there is left out.
std::map<std::string, std::string> read_log_folder(const std::filesystem::path& folder);

/// Converts irace.Rdata with R, by the script that this program carries. Unavailable when there is
/// no Rscript, BadInput when it refuses the file.
Expected<std::map<std::string, std::string>> convert_irace_log(const std::filesystem::path& log,
                                                               Output& output);

/// The tables as the bytes of an irace.Rdata. Unavailable when there is no Rscript, or it refuses
/// them; `log` is its name in messages.
Expected<std::string> make_irace_log(const std::map<std::string, std::string>& tables,
                                     const std::filesystem::path& log, Output& output);

}  // namespace swarmsmith::cli
