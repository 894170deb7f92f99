#include <sys/mman.h>
#include <unistd.h>

#include <string>

#include "tests/fuzz/fuzz.h"
#include "tracking/video/frame_source.h"

namespace swarmsmith::fuzz {

/// A bag is refused with a sentence, or gives images in order, of one size, until its end or a
/// sentence. A file in memory.
void run(std::string_view input) {
  const int file = ::memfd_create("bag", MFD_CLOEXEC);
  require(::write(file, input.data(), input.size()) == static_cast<ssize_t>(input.size()),
          "memory");
  const auto source = FrameSource::open("/proc/self/fd/" + std::to_string(file));
  if (!source) {
    require(source.error().message.starts_with("E_"), "it says why");
  } else {
    const SourceInfo& info = (*source)->info();
    std::int64_t last = -1;
    while (true) {
      const auto more = (*source)->next();
      if (!more) require(!more.error().message.empty(), "it says why");
      if (!more || !*more) break;
      const Frame& frame = (*source)->frame();
      require(frame.number > last && frame.number < info.expected_frames, "numbers grow");
      require(frame.gray.width == info.size.width && frame.gray.height == info.size.height, "size");
      last = frame.number;
      require((*source)->color().bgr.size() == 3 * static_cast<std::size_t>(info.size.width) *
                                                   static_cast<std::size_t>(info.size.height),
              "colours of every pixel");
    }
    require((*source)->damaged_frames() >= 0, "damage is counted");
  }
  ::close(file);
}

}  // namespace swarmsmith::fuzz
