#pragma once

#include <string>

#include "base/expected.h"

namespace swarmsmith {

/// That the files are there which the folder's metadata.yaml, as rosbag2 writes it, names, and that
/// no file is packed as a whole (`run_0.mcap.zstd`). Without that file what is there counts.
/// E_VIDEO_UNREADABLE. `word`: a folder or a file; what is not a bag passes.
Expected<void> check_bag_parts(const std::string& word);

}  // namespace swarmsmith
