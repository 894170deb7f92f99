#pragma once

#include <optional>
#include <string>

#include "base/expected.h"
#include "tracking/rig/rig_file.h"

namespace swarmsmith {

/// Questions about files that a command writes at its end, asked before its work. None of them
/// makes or changes a file. Nothing for "" and "-", which is standard output.

/// Unavailable if the file's folder does not exist, or nothing can be written there.
std::optional<Error> flaw_of_output(const std::string& file);
/// The same, and BadInput if the file exists: it is never overwritten.
std::optional<Error> flaw_of_new_output(const std::string& file);
/// The same for a folder with pictures, which may exist if it is empty.
std::optional<Error> flaw_of_new_folder(const std::string& folder);
/// As flaw_of_output, and BadInput if the file exists and is not a calibration of this kind, of
/// this robot: those may be replaced.
std::optional<Error> flaw_of_calibration_output(const std::string& file, CalibrationKind kind,
                                                const std::string& robot = "");

}  // namespace swarmsmith
