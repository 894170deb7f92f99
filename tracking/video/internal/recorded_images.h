#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tracking/video/frame_source.h"

namespace swarmsmith {

/// The encoding of a message's fields.
enum class MessageForm { Cdr, Ros1 };

/// The bytes of a message.
struct RecordedMessage {
  std::int64_t recorded_ns = 0;   ///< since 1970
  std::uint8_t* bytes = nullptr;  ///< followed by AV_INPUT_BUFFER_PADDING_SIZE more bytes
  std::size_t size = 0;
};

/// Reads the messages of one topic in sequence.
class MessageReader {
 public:
  virtual ~MessageReader() = default;
  /// Nothing at the end. The bytes are valid until the next message is read.
  virtual Expected<std::optional<RecordedMessage>> next() = 0;
  virtual void rewind() = 0;
  virtual std::int64_t count() const = 0;
  /// Whether the file ends earlier than it says.
  virtual bool is_cut() const { return false; }
};

/// Opens the images in messages. Times are those in the messages' headers; if the first image has
/// no time, they are the times of recording.
Expected<std::unique_ptr<FrameSource>> open_recorded(std::string name,
                                                     std::unique_ptr<MessageReader> messages,
                                                     MessageForm form, bool is_packed);

}  // namespace swarmsmith
