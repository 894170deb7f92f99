#pragma once

#include <functional>
#include <string>

#include "base/expected.h"

namespace swarmsmith {

/// Unpacks a chunk (`bz2`, `lz4`) into `into`, which has its size; false when it is damaged.
using UnpackChunk =
    std::function<bool(const std::string& packing, std::string& packed, std::string& into)>;

/// Whether a bag is whole, before rosbag's library reads it, which believes every length and offset
/// and reads beyond its memory for a wrong one: records within their bounds, an index that leads to
/// messages, connections that are there. Reads headers alone, but unpacks what is packed; a chunk
/// that cannot be unpacked is left to the library, whose checksums refuse it, too.
/// E_VIDEO_UNREADABLE, with the place in the file, and what to do.
/// Source: http://wiki.ros.org/Bags/Format/2.0.
Expected<void> check_bag(const std::string& file, const UnpackChunk& unpack);

}  // namespace swarmsmith
