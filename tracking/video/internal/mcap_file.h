#pragma once

#include <memory>

#include "tracking/video/frame_source.h"
#include "tracking/video/internal/bag_word.h"

namespace swarmsmith {

/// The images of a topic of an MCAP file, as ROS 2 (CDR) or ROS 1 writes them, in the order in
/// which they were recorded. Read from front to back, so that a recording that was cut off gives
/// what it has; chunks may be packed with zstd or lz4, and one is in memory at a time.
/// Source: https://mcap.dev/spec.
Expected<std::unique_ptr<FrameSource>> open_mcap(const BagWord& word);

}  // namespace swarmsmith
