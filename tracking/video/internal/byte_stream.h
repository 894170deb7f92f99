#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "base/expected.h"
#include "tracking/video/internal/av.h"

namespace swarmsmith::av {

/// Bytes under libavformat: a file that is open, or a text in memory. Not by its own protocols, so
/// that a path is never taken for an address, and the system's errors can be told in its own words.
class ByteStream {
 public:
  /// E_VIDEO_UNREADABLE when it cannot be read.
  static Expected<ByteStream> reading(const std::string& path);
  /// The bytes must outlive the stream.
  static ByteStream over(std::string_view bytes);
  /// Made anew, or emptied. Unavailable when that is not possible.
  static Expected<ByteStream> writing(const std::string& path);

  ByteStream(ByteStream&&) noexcept;
  ByteStream& operator=(ByteStream&&) noexcept;
  ~ByteStream();

  AVIOContext* io() const;
  std::int64_t size() const;
  /// The system's first error of writing, as `errno` has it; 0: none so far.
  int failed_with() const;
  /// Hands all to the disk and closes; what the system says then.
  int close_after_writing();

 private:
  struct State;
  explicit ByteStream(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace swarmsmith::av
