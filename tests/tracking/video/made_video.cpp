#include "tests/tracking/video/made_video.h"

#include <fstream>
#include <stdexcept>

namespace swarmsmith {
namespace {

constexpr int kBits = 10;
constexpr int kSquare = 24;

struct Corner {
  int x = 0;
  int y = 0;
};

/// Left upper corner of the square of a bit.
Corner corner_of(int bit) {
  constexpr int kAcross = 5;
  constexpr int kMargin = 8;
  return {kMargin + 30 * (bit % kAcross), kMargin + 44 * (bit / kAcross)};
}

void check(const Expected<void>& done) {
  if (!done) throw std::runtime_error(to_string(done.error()));
}

}  // namespace

std::vector<std::uint8_t> numbered_picture(int number, ImageSize size) {
  std::vector<std::uint8_t> pixels;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x)
      pixels.push_back(static_cast<std::uint8_t>(90 + (x + 2 * y + 5 * number) % 64));
  }
  for (int bit = 0; bit < kBits; ++bit) {
    const Corner at = corner_of(bit);
    for (int y = 0; y < kSquare; ++y) {
      for (int x = 0; x < kSquare; ++x) {
        const auto place = static_cast<std::size_t>((at.y + y) * size.width + at.x + x);
        pixels[place] = ((number >> bit) & 1) != 0 ? 230 : 20;
      }
    }
  }
  return pixels;
}

GrayImage gray_image(const std::vector<std::uint8_t>& pixels, ImageSize size) {
  return {pixels.data(), size.width, size.height, size.width};
}

std::optional<int> number_in(const GrayImage& image) {
  int number = 0;
  for (int bit = 0; bit < kBits; ++bit) {
    const Corner at = corner_of(bit);
    int dark = 0;
    int bright = 0;
    for (int y = 4; y < kSquare - 4; ++y) {
      for (int x = 4; x < kSquare - 4; ++x) {
        const std::uint8_t value = image.pixels[(at.y + y) * image.stride + at.x + x];
        (value < 128 ? dark : bright) += 1;
      }
    }
    if (dark != 0 && bright != 0) return std::nullopt;
    if (bright != 0) number |= 1 << bit;
  }
  return number;
}

std::vector<double> even_times(int frames, double rate) {
  std::vector<double> times;
  for (int i = 0; i < frames; ++i)
    times.push_back(i / rate);
  return times;
}

std::vector<double> uneven_times(int frames) {
  std::vector<double> times;
  int ms = 250;
  for (int i = 0; i < frames; ++i) {
    times.push_back(ms / 1000.0);
    ms += i == frames / 2 ? 2500 : 20 + (i * 37) % 61;
  }
  return times;
}

void make_video(const std::filesystem::path& path, const std::vector<double>& times,
                const VideoOptions& options) {
  std::filesystem::remove(path);  // one that was read is no longer wanted
  auto writer = VideoWriter::open(path.string(), kMadeSize, options);
  if (!writer) throw std::runtime_error(to_string(writer.error()));
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto pixels = numbered_picture(static_cast<int>(i));
    check(writer->write(gray_image(pixels), times[i]));
  }
  check(writer->finish());
}

ReadVideo read_video(const std::string& word) {
  ReadVideo read;
  auto source = FrameSource::open(word);
  if (!source) {
    read.error = source.error();
    return read;
  }
  read.info = (*source)->info();
  while (true) {
    const auto more = (*source)->next();
    if (!more) read.error = more.error();
    if (!more || !*more) break;
    const Frame& frame = (*source)->frame();
    read.frames.push_back({frame.number, frame.time_s, number_in(frame.gray)});
  }
  read.damaged = (*source)->damaged_frames();
  return read;
}

void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

}  // namespace swarmsmith
