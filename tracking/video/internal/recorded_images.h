#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tracking/video/frame_source.h"

namespace swarmsmith {

/// How the fields of a message lie in its bytes.
enum class MessageForm { Cdr, Ros1 };

/// A message's bytes.
struct RecordedMessage {
  std::int64_t recorded_ns = 0;   ///< since 1970
  std::uint8_t* bytes = nullptr;  ///< with AV_INPUT_BUFFER_PADDING_SIZE bytes after it
  std::size_t size = 0;
};

/// The messages of one topic, one after the other.
class MessageReader {
 public:
  virtual ~MessageReader() = default;
  /// Nothing at the end. The bytes live until the next one is asked for.
  virtual Expected<std::optional<RecordedMessage>> next() = 0;
  virtual void rewind() = 0;
  virtual std::int64_t count() const = 0;
  /// The file ends before it says so.
  virtual bool is_cut() const { return false; }
};

/// Their images. Times are those of the messages' headers; where the first image has none, when
/// each was recorded.
Expected<std::unique_ptr<FrameSource>> open_recorded(std::string name,
                                                     std::unique_ptr<MessageReader> messages,
                                                     MessageForm form, bool is_packed);

}  // namespace swarmsmith
