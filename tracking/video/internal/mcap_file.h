#pragma once

#include <memory>

#include "tracking/video/frame_source.h"
#include "tracking/video/internal/bag_word.h"

namespace swarmsmith {

/// Opens the images of a topic of an MCAP file, in the encoding of ROS 2 (CDR) or ROS 1, in the
/// order in which they were recorded. The file is read from front to back, so that a truncated
/// recording still gives its contents. Chunks may be compressed with zstd or lz4; only one is in
/// memory at a time. Source: https://mcap.dev/spec.
Expected<std::unique_ptr<FrameSource>> open_mcap(const BagWord& word);

}  // namespace swarmsmith
