/// refilm IN OUT WRITER RATE FRAME...: the pictures of a video by their numbers, in this order, as
/// another recorder would have written them: `opencv` (its VideoWriter, MJPG or mp4v), or a codec
/// of ours (h264, mjpeg, ffv1) with times n / RATE. `A-B` is a row of frames, `A*N` one N times,
/// `*N` all of them N times, `/N` every N-th, N times, `~` all of them backwards, `%` each two
/// exchanged. Of a codec of ours, times may be wrong:
/// `@jitter:MS` each by up to that, `@step:S:BY` all from S on, seconds. Pictures may be changed:
/// `@mirror`, `@crop` and `@letterbox` to the same size, `@half`, `@weave` rows of each two
/// pictures.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <exception>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
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

struct Changes {
  double jitter_s = 0;
  double step_at_s = 0;
  double step_s = 0;
  std::vector<std::string> of_picture;

  bool has(std::string_view name) const {
    return std::ranges::find(of_picture, name) != of_picture.end();
  }
  double time_of(int number, double rate) const {
    const double time = number / rate;
    // Some numbers that do not repeat, -1 to 1.
    return time + jitter_s * std::sin(37.0 * number) + (time >= step_at_s ? step_s : 0);
  }
};

/// Takes the words that are not frames.
Changes changes_of(std::vector<std::string>& words) {
  Changes changes;
  for (const std::string& word : words) {
    if (!word.starts_with('@')) continue;
    const std::size_t first = word.find(':');
    if (word.starts_with("@jitter:")) {
      changes.jitter_s = std::stod(word.substr(first + 1)) / 1000;
    } else if (word.starts_with("@step:")) {
      changes.step_at_s = std::stod(word.substr(first + 1));
      changes.step_s = std::stod(word.substr(word.rfind(':') + 1));
    } else {
      changes.of_picture.push_back(word);
    }
  }
  std::erase_if(words, [](const std::string& word) { return word.starts_with('@'); });
  return changes;
}

cv::Mat mat_of(ColorImage& image) {
  return {image.height, image.width, CV_8UC3, image.bgr.data()};
}

cv::Mat changed(ColorImage& image, ColorImage& next, const Changes& changes) {
  cv::Mat picture = mat_of(image).clone();
  const cv::Size size = picture.size();
  if (changes.has("@weave")) {
    for (int row = 1; row < size.height; row += 2)
      mat_of(next).row(row).copyTo(picture.row(row));
  }
  if (changes.has("@mirror")) cv::flip(picture, picture, 1);
  if (changes.has("@half")) cv::resize(picture, picture, size / 2, 0, 0, cv::INTER_AREA);
  if (changes.has("@crop")) {
    const cv::Rect middle(size.width / 20, size.height / 20, size.width * 9 / 10,
                          size.height * 9 / 10);
    cv::resize(picture(middle).clone(), picture, size);
  }
  if (changes.has("@letterbox")) {
    cv::Mat smaller;
    cv::resize(picture, smaller, {size.width, size.height * 9 / 10}, 0, 0, cv::INTER_AREA);
    picture.setTo(0);
    smaller.copyTo(picture.rowRange(size.height / 20, size.height / 20 + smaller.rows));
  }
  return picture;
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
    if (word == "~" || word == "%") {
      for (std::size_t i = 0; i < frames; ++i)
        order.push_back(word == "~" ? frames - 1 - i : std::min(i ^ 1U, frames - 1));
      continue;
    }
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
  Writer(const std::string& path, ImageSize size, const std::string& writer, double rate,
         const Changes& changes)
      : rate_(rate), changes_(changes) {
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

  void write(const cv::Mat& picture) {
    if (!own_) return other_.write(picture);
    ColorImage image;
    image.width = picture.cols;
    image.height = picture.rows;
    image.bgr.assign(picture.datastart, picture.dataend);
    must(own_->write(image, changes_.time_of(written_++, rate_)));
  }
  void finish() {
    if (own_) must(own_->finish());
    other_.release();
  }

 private:
  double rate_;
  const Changes& changes_;
  int written_ = 0;
  std::optional<VideoWriter> own_;
  cv::VideoWriter other_;
};

void run(std::vector<std::string> words) {
  const Changes changes = changes_of(words);
  if (words.size() < 6) throw std::runtime_error("refilm IN OUT WRITER RATE FRAME...");
  const auto source = must(FrameSource::open(words[1]));
  std::vector<ColorImage> pictures;
  while (must(source->next()))
    pictures.push_back(source->color());
  ImageSize size = source->info().size;
  if (changes.has("@half")) size = {size.width / 2, size.height / 2};
  Writer writer(words[2], size, words[3], std::stod(words[4]), changes);
  for (const std::size_t i : order_of(std::vector(words.begin() + 5, words.end()), pictures.size()))
    writer.write(
        changed(pictures.at(i), pictures.at(std::min(i + 1, pictures.size() - 1)), changes));
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
