#pragma once

#include <string>

#include "base/expected.h"

namespace swarmsmith {

/// Checks that the files named in the folder's metadata.yaml (written by rosbag2) exist, and that
/// no file is compressed as a whole (`run_0.mcap.zstd`). Without metadata.yaml, the existing files
/// are accepted. E_VIDEO_UNREADABLE. `word` is a folder or a file; anything that is not a bag
/// passes.
Expected<void> check_bag_parts(const std::string& word);

}  // namespace swarmsmith
