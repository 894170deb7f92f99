#include <optional>

#include "tests/fuzz/fuzz.h"
#include "tracking/video/frame_source.h"
#include "tracking/video/internal/video_file.h"

namespace swarmsmith::fuzz {
namespace {

/// Touches every pixel, so that memory that is not there is noticed.
unsigned sum_of(const GrayImage& image) {
  unsigned sum = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x)
      sum += image.pixels[y * image.stride + x];
  }
  return sum;
}

}  // namespace

/// A video is refused with a sentence, or gives frames in order, of one size, until its end or a
/// sentence.
void run(std::string_view input) {
  const auto source = open_video_bytes(input, "bytes");
  if (!source) {
    return require(source.error().message.starts_with("E_VIDEO_UNREADABLE: "), "it says why");
  }
  const SourceInfo& info = (*source)->info();
  require(info.expected_frames > 0, "there is a frame");
  std::int64_t last = -1;
  std::optional<double> time;
  constexpr int kMostFrames = 60;
  for (int i = 0; i < kMostFrames; ++i) {
    const auto more = (*source)->next();
    if (!more) return require(!more.error().message.empty(), "it says why");
    if (!*more) break;
    const Frame& frame = (*source)->frame();
    require(frame.number > last, "numbers grow");
    require(frame.time_s.has_value() == info.has_times, "times are there or not");
    require(!time || *frame.time_s > *time, "times grow");
    require(frame.gray.width == info.size.width && frame.gray.height == info.size.height, "size");
    last = frame.number;
    time = frame.time_s;
    sum_of(frame.gray);
    if (i == 0) {
      const ColorImage color = (*source)->color();
      require(color.bgr.size() == 3 * static_cast<std::size_t>(info.size.width) *
                                      static_cast<std::size_t>(info.size.height),
              "colours of every pixel");
    }
  }
  require((*source)->damaged_frames() >= 0, "damage is counted");
}

}  // namespace swarmsmith::fuzz
