#pragma once

#include <string>

#include "base/expected.h"

namespace swarmsmith {

/// Whether a bag is whole, before rosbag's library reads it, which believes every length and offset
/// and reads beyond its memory for a wrong one: records within their bounds, an index that leads to
/// messages, connections that are there. Reads headers alone; what is packed (bz2, lz4) has
/// checksums that the library looks at. E_VIDEO_UNREADABLE, with the place in the file, and what to
/// do. Source: http://wiki.ros.org/Bags/Format/2.0.
Expected<void> check_bag(const std::string& file);

}  // namespace swarmsmith
