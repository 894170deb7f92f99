#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/expected.h"
#include "tracking/video/internal/bag_records.h"
#include "tracking/video/internal/byte_stream.h"

namespace swarmsmith::bag {

/// A publisher's topic.
struct Connection {
  std::string topic;
  std::string type;
  std::string md5;  ///< of the type's definition
};

/// Where a message lies.
struct Entry {
  std::int64_t recorded_ns = 0;  ///< since 1970
  std::int64_t chunk = 0;        ///< where its record begins
  std::uint32_t place = 0;       ///< in the chunk, of the message or of its connection before it
  std::uint32_t connection = 0;
};

struct Index {
  std::map<std::uint32_t, Connection> connections;  ///< those with messages
  std::vector<Entry> entries;                       ///< as they lie
};

/// Reads from a file; its stream is shared by all copies.
Read reading_of(std::shared_ptr<av::ByteStream> bytes);

/// Reads a bag's index, and looks whether the bag is whole: records within their bounds, and
/// connections that are there. Reads headers alone: whether an entry leads to its message, its
/// reader sees. E_VIDEO_UNREADABLE, with the place in the file, and what to do.
Expected<Index> read_index(std::int64_t size, const Read& read, const std::string& name);

}  // namespace swarmsmith::bag
