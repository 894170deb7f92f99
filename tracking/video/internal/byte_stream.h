#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "base/expected.h"
#include "tracking/video/internal/av.h"

namespace swarmsmith::av {

/// Gives libavformat its bytes, from an open file or from memory. The library's own protocols are
/// not used, so that a path is never taken for a URL, and error messages of the system can be
/// shown.
class ByteStream {
 public:
  /// E_VIDEO_UNREADABLE if the file cannot be read.
  static Expected<ByteStream> reading(const std::string& path);
  /// The bytes must outlive the stream.
  static ByteStream over(std::string_view bytes);
  /// Creates or truncates the file. Unavailable if this fails.
  static Expected<ByteStream> writing(const std::string& path);

  ByteStream(ByteStream&&) noexcept;
  ByteStream& operator=(ByteStream&&) noexcept;
  ~ByteStream();

  AVIOContext* io() const;
  std::int64_t size() const;
  /// The first error of writing as an `errno` value; 0 if there was none.
  int failed_with() const;
  /// Writes everything to the disk and closes the file; returns the `errno` value of an error.
  int close_after_writing();

 private:
  struct State;
  explicit ByteStream(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace swarmsmith::av
