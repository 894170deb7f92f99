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

/// A topic of one publisher.
struct Connection {
  std::string topic;
  std::string type;
  std::string md5;  ///< checksum of the type's definition
};

/// The location of a message.
struct Entry {
  std::int64_t recorded_ns = 0;  ///< since 1970
  std::int64_t chunk = 0;        ///< where the chunk's record begins
  std::uint32_t place = 0;       ///< offset in the chunk, of the message or its connection
  std::uint32_t connection = 0;
};

struct Index {
  std::map<std::uint32_t, Connection> connections;  ///< connections with messages
  std::vector<Entry> entries;                       ///< in the order of the file
};

/// Reads from a file; all copies share its stream.
Read reading_of(std::shared_ptr<av::ByteStream> bytes);

/// Reads a bag's index and checks that the bag is complete: that records are within their bounds,
/// and that all connections exist. Reads only headers; whether an entry points to its message is
/// checked when the message is read. E_VIDEO_UNREADABLE, with the position in the file, and advice.
Expected<Index> read_index(std::int64_t size, const Read& read, const std::string& name);

}  // namespace swarmsmith::bag
