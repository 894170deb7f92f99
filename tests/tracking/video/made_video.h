#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tracking/video/frame_source.h"
#include "tracking/video/video_writer.h"

namespace swarmsmith {

/// Size of the test's pictures.
inline constexpr ImageSize kMadeSize{160, 96};

/// A picture that carries a number in large squares, over a background that moves with it.
std::vector<std::uint8_t> numbered_picture(int number, ImageSize size = kMadeSize);
GrayImage gray_image(const std::vector<std::uint8_t>& pixels, ImageSize size = kMadeSize);
/// The number that a picture carries; nothing when its squares are neither dark nor bright.
std::optional<int> number_in(const GrayImage& image);

/// 0, 1/rate, 2/rate, ...
std::vector<double> even_times(int frames, double rate);
/// Uneven, in whole milliseconds, with a gap of 2.5 s in the middle.
std::vector<double> uneven_times(int frames);

/// A video of numbered pictures at these times. Throws when it cannot be written.
void make_video(const std::filesystem::path& path, const std::vector<double>& times,
                const VideoOptions& options);

struct ReadFrame {
  std::int64_t number = 0;
  std::optional<double> time_s;
  std::optional<int> code;  ///< what the picture carries
};

struct ReadVideo {
  SourceInfo info;
  std::vector<ReadFrame> frames;
  std::int64_t damaged = 0;
  std::optional<Error> error;  ///< at opening, or in the middle
};
ReadVideo read_video(const std::string& word);

void write_bytes(const std::filesystem::path& path, const std::string& bytes);

}  // namespace swarmsmith
