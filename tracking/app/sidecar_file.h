#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"

namespace swarmsmith {

/// The file of frame times beside a video, folder or bag: "run07.times.csv" for run07.mp4 and for
/// the folder run07, or "run07.mp4.times.csv". Empty if there is none.
std::filesystem::path sidecar_beside(const std::string& source);

/// Its times, if there is such a file.
Expected<std::optional<std::vector<double>>> times_beside(const std::string& source);

}  // namespace swarmsmith
