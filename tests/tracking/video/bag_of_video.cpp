/// bag_of_video VIDEO BAG TOPIC BEGIN [TIMES]: the brightness of a video's frames as images of a
/// bag, the first one BEGIN nanoseconds after 1970, with the times of the video, or of a file of
/// frame times. Prints the stamps, seconds, as such a file.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/tracking/video/written_bag.h"
#include "tracking/video/frame_clock.h"
#include "tracking/video/frame_source.h"

namespace swarmsmith {
namespace {

template <class T>
T must(Expected<T> value) {
  if (!value) throw std::runtime_error(to_string(value.error()));
  return std::move(*value);
}

std::optional<std::vector<double>> sidecar(const std::string& file) {
  if (file.empty()) return std::nullopt;
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return must(parse_frame_times(text.str()));
}

void write(const std::vector<std::string>& words) {
  const auto source = must(FrameSource::open(words.at(1)));
  FrameClock clock =
      must(FrameClock::of(source->info(), sidecar(words.size() > 5 ? words[5] : "")));
  WrittenBag bag(words.at(2));
  const BagTime begin = std::stoll(words.at(4));
  std::optional<double> first_s;
  fmt::print("frame,time_s\n");
  for (int row = 0; must(source->next()); ++row) {
    const Frame& frame = source->frame();
    const double time_s = must(clock.time_of(frame));
    if (!first_s) first_s = time_s;
    const BagTime stamp = begin + std::llround((time_s - *first_s) * 1e9);
    fmt::print("{},{}.{:09}\n", row, stamp / 1'000'000'000, stamp % 1'000'000'000);
    BagImage image;
    image.stamp = stamp;
    image.recorded = stamp + 3'000'000;
    image.width = static_cast<std::uint32_t>(frame.gray.width);
    image.height = static_cast<std::uint32_t>(frame.gray.height);
    image.step = image.width;
    for (int y = 0; y < frame.gray.height; ++y) {
      const std::uint8_t* const begins = frame.gray.pixels + y * frame.gray.stride;
      image.data.insert(image.data.end(), begins, begins + frame.gray.width);
    }
    bag.add(words.at(3), image);
  }
}

}  // namespace
}  // namespace swarmsmith

int main(int count, char** words) {
  try {
    swarmsmith::write({words, words + count});
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "bag_of_video: {}\n", error.what());
    return 1;
  }
}
