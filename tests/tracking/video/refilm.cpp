/// refilm IN OUT WRITER RATE FRAME...: the pictures of a video by their numbers, in this order, as
/// another recorder would have written them: `opencv` (its VideoWriter, MJPG or mp4v), or a codec
/// of ours (h264, mjpeg, ffv1) with times n / RATE. `A-B` is a row of frames, `A*N` one N times,
/// `*N` all of them N times, `/N` every N-th, N times.
#include <fmt/format.h>

#include <charconv>
#include <cstdio>
#include <exception>
#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "tracking/video/frame_source.h"
#include "tracking/video/video_writer.h"

namespace swarmsmith {
namespace {

template <class T>
T must(Expected<T> value) {
  if (!value) throw std::runtime_error(to_string(value.error()));
  return std::move(*value);
}
void must(const Expected<void>& value) {
  if (!value) throw std::runtime_error(to_string(value.error()));
}

std::size_t number_of(std::string_view text) {
  std::size_t value = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  if (read.ec != std::errc{} || read.ptr != text.data() + text.size())
    throw std::runtime_error("no number: " + std::string(text));
  return value;
}

std::vector<std::size_t> order_of(const std::vector<std::string>& words, std::size_t frames) {
  std::vector<std::size_t> order;
  for (const std::string_view word : words) {
    const std::size_t times = word.find('*');
    const std::size_t row = word.find('-');
    const std::size_t count =
        times == std::string_view::npos ? 1 : number_of(word.substr(times + 1));
    std::size_t from = 0;
    std::size_t to = frames - 1;
    std::size_t step = 1;
    if (word.starts_with('/')) {
      step = number_of(word.substr(1));
      for (std::size_t i = 0; i < frames; ++i)
        order.push_back(i / step * step);
      continue;
    }
    if (row != std::string_view::npos) {
      from = number_of(word.substr(0, row));
      to = std::min(to, number_of(word.substr(row + 1)));
    } else if (!word.starts_with('*')) {
      from = to = number_of(word.substr(0, times));
    }
    for (std::size_t i = from; i <= to; ++i)
      order.insert(order.end(), count, i);
  }
  return order;
}

class Writer {
 public:
  Writer(const std::string& path, ImageSize size, const std::string& writer, double rate)
      : rate_(rate) {
    if (writer != "opencv") {
      VideoOptions options;
      options.codec = writer;
      options.frame_rate = rate;
      options.quality = 70;
      own_.emplace(must(VideoWriter::open(path, size, options)));
      return;
    }
    const int code = path.ends_with(".mp4") ? cv::VideoWriter::fourcc('m', 'p', '4', 'v')
                                            : cv::VideoWriter::fourcc('M', 'J', 'P', 'G');
    if (!other_.open(path, code, rate, cv::Size(size.width, size.height)))
      throw std::runtime_error("OpenCV cannot write " + path);
  }

  void write(ColorImage& image) {
    if (own_) {
      must(own_->write(image, static_cast<double>(written_++) / rate_));
    } else {
      other_.write(cv::Mat(image.height, image.width, CV_8UC3, image.bgr.data()));
    }
  }
  void finish() {
    if (own_) must(own_->finish());
    other_.release();
  }

 private:
  double rate_;
  int written_ = 0;
  std::optional<VideoWriter> own_;
  cv::VideoWriter other_;
};

void run(const std::vector<std::string>& words) {
  if (words.size() < 6) throw std::runtime_error("refilm IN OUT WRITER RATE FRAME...");
  const auto source = must(FrameSource::open(words[1]));
  std::vector<ColorImage> pictures;
  while (must(source->next()))
    pictures.push_back(source->color());
  Writer writer(words[2], source->info().size, words[3], std::stod(words[4]));
  for (const std::size_t i : order_of(std::vector(words.begin() + 5, words.end()), pictures.size()))
    writer.write(pictures.at(i));
  writer.finish();
}

}  // namespace
}  // namespace swarmsmith

int main(int count, char** words) {
  try {
    swarmsmith::run({words, words + count});
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "refilm: {}\n", error.what());
    return 1;
  }
}
