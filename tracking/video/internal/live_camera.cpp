#include "tracking/video/internal/live_camera.h"

#include <fmt/format.h>

#include <charconv>
#include <condition_variable>
#include <deque>
#include <exception>
#include <filesystem>
#include <mutex>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <optional>
#include <thread>
#include <utility>

#include "tracking/rig/issue.h"
#include "tracking/video/internal/picture.h"

namespace swarmsmith {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::string_view kCamera = "camera:";
constexpr std::string_view kOpenCv = "opencv:";

Unexpected unreadable(const std::string& text, const std::string& name) {
  return Unexpected(error_of(IssueCode::VideoUnreadable, text, name));
}

/// What a word asks for.
struct CameraWord {
  std::string name;          ///< the whole word
  std::optional<int> index;  ///< of a device, or
  std::string address;       ///< for OpenCV
  ImageSize size;            ///< 0 x 0: the driver's choice
  double frame_rate = 0;     ///< 0: the driver's choice
  bool is_file = false;
};

/// Takes a number off the front.
template <class Number>
bool take(std::string_view& text, Number& value) {
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  if (read.ec != std::errc{}) return false;
  text.remove_prefix(static_cast<std::size_t>(read.ptr - text.data()));
  return true;
}

bool take(std::string_view& text, char c) {
  if (!text.starts_with(c)) return false;
  text.remove_prefix(1);
  return true;
}

Expected<CameraWord> camera_word(const std::string& word) {
  CameraWord camera;
  camera.name = word;
  std::string_view rest = word;
  if (!rest.starts_with(kCamera)) {
    if (rest.starts_with(kOpenCv)) rest.remove_prefix(kOpenCv.size());
    camera.address = rest;
    std::error_code ignored;
    camera.is_file = std::filesystem::exists(camera.address, ignored);
    return camera;
  }
  rest.remove_prefix(kCamera.size());
  int index = -1;
  bool right = take(rest, index) && index >= 0;
  if (right && !rest.empty()) {
    right = take(rest, ':') && take(rest, camera.size.width) && take(rest, 'x') &&
            take(rest, camera.size.height) && av::is_taken(camera.size.width, camera.size.height);
    if (right && !rest.empty()) {
      right = take(rest, '@') && take(rest, camera.frame_rate) && camera.frame_rate > 0;
    }
  }
  if (!right || !rest.empty()) {
    return Unexpected(error_of(IssueCode::Config,
                               "a camera is named like camera:0 or camera:0:1920x1080@30", word));
  }
  camera.index = index;
  return camera;
}

struct Arrived {
  cv::Mat picture;
  double time_s = 0;
  std::int64_t number = 0;
};

/// What the thread that reads and the thread that tracks have in common.
struct Shared {
  std::mutex mutex;
  std::condition_variable changed;
  std::deque<Arrived> queue;
  bool is_open = false;
  bool has_ended = false;  ///< or could not be opened
  std::string complaint;
  bool stop = false;
  ImageSize size;
  double frame_rate = 0;
  std::int64_t dropped = 0;
};

/// The thread that reads. A driver or a network can hold it for ever, so that nobody waits for it.
class Reader {
 public:
  Reader(CameraWord word, std::shared_ptr<Shared> shared)
      : word_(std::move(word)), shared_(std::move(shared)) {}

  void run() {
    std::string complaint;
    try {
      complaint = read_all();
    } catch (const std::exception& error) {
      complaint = error.what();
    }
    const std::scoped_lock lock(shared_->mutex);
    shared_->complaint = complaint;
    shared_->has_ended = true;
    shared_->changed.notify_all();
  }

 private:
  /// Why it ended; empty: no more pictures.
  std::string read_all() {
    if (!open()) return "OpenCV cannot open it; is it there, and free?";
    has_driver_times_ = camera_.getBackendName() == "V4L2";
    rate_ = camera_.get(cv::CAP_PROP_FPS);
    constexpr double kMostRate = 1000;
    if (!(rate_ > 0 && rate_ <= kMostRate)) rate_ = 0;
    const Clock::time_point start = Clock::now();
    for (std::int64_t number = 0;; ++number) {
      cv::Mat picture;
      if (!camera_.read(picture) || picture.empty()) return {};
      if (!av::is_taken(picture.cols, picture.rows)) return "its pictures are too large";
      if (word_.is_file && rate_ > 0) {
        std::this_thread::sleep_until(
            start + std::chrono::duration_cast<Clock::duration>(
                        std::chrono::duration<double>(static_cast<double>(number) / rate_)));
      }
      const double time = time_of_picture();
      if (!hand_over({std::move(picture), time, number})) return {};
    }
  }

  bool open() {
    if (!word_.index) return camera_.open(word_.address);
    if (!camera_.open(*word_.index)) return false;
    if (word_.size.width > 0) {
      // Raw pictures of this size seldom fit through USB.
      camera_.set(cv::CAP_PROP_FOURCC, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'));
      camera_.set(cv::CAP_PROP_FRAME_WIDTH, word_.size.width);
      camera_.set(cv::CAP_PROP_FRAME_HEIGHT, word_.size.height);
    }
    if (word_.frame_rate > 0) camera_.set(cv::CAP_PROP_FPS, word_.frame_rate);
    return true;
  }

  double time_of_picture() {
    const double now = std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
    constexpr double kMilliseconds = 1e-3;
    if (has_driver_times_) {
      const double driver = camera_.get(cv::CAP_PROP_POS_MSEC) * kMilliseconds;
      if (driver > 0) return driver;
      has_driver_times_ = false;
    }
    return rate_ > 0 ? now - 0.5 / rate_ : now;
  }

  /// False when nobody wants more.
  bool hand_over(Arrived arrived) {
    constexpr std::size_t kMostWaiting = 16;
    const std::scoped_lock lock(shared_->mutex);
    if (shared_->stop) return false;
    if (!shared_->is_open) {
      shared_->is_open = true;
      shared_->size = {arrived.picture.cols, arrived.picture.rows};
      shared_->frame_rate = rate_;
    }
    if (shared_->queue.size() == kMostWaiting) {
      shared_->queue.pop_front();
      ++shared_->dropped;
    }
    shared_->queue.push_back(std::move(arrived));
    shared_->changed.notify_all();
    return true;
  }

  CameraWord word_;
  std::shared_ptr<Shared> shared_;  // shared, since this thread may outlive who started it
  cv::VideoCapture camera_;
  bool has_driver_times_ = false;
  double rate_ = 0;
};

class LiveCamera final : public FrameSource {
 public:
  LiveCamera(SourceInfo info, std::shared_ptr<Shared> shared, std::chrono::milliseconds patience)
      : info_(std::move(info)), shared_(std::move(shared)), patience_(patience) {}
  LiveCamera(const LiveCamera&) = delete;
  LiveCamera& operator=(const LiveCamera&) = delete;
  ~LiveCamera() override {
    const std::scoped_lock lock(shared_->mutex);
    shared_->stop = true;
  }

  const SourceInfo& info() const override { return info_; }
  const Frame& frame() const override { return frame_; }

  Expected<bool> next() override {
    {
      std::unique_lock lock(shared_->mutex);
      const bool came = shared_->changed.wait_for(
          lock, patience_, [&] { return !shared_->queue.empty() || shared_->has_ended; });
      if (!came) {
        return unreadable(fmt::format("no picture came for {} s; is the camera still there?",
                                      std::chrono::duration<double>(patience_).count()),
                          info_.name);
      }
      if (shared_->queue.empty()) {
        if (!shared_->complaint.empty()) return unreadable(shared_->complaint, info_.name);
        return false;
      }
      arrived_ = std::move(shared_->queue.front());
      shared_->queue.pop_front();
      dropped_ = shared_->dropped;
    }
    const cv::Mat& picture = arrived_.picture;
    if (picture.cols != info_.size.width || picture.rows != info_.size.height) {
      return unreadable(
          fmt::format("frame {} is {} x {} pixels, those before it {} x {}", arrived_.number,
                      picture.cols, picture.rows, info_.size.width, info_.size.height),
          info_.name);
    }
    if (picture.depth() != CV_8U || (picture.channels() != 1 && picture.channels() != 3)) {
      return unreadable("its pixel format is not 8 bits of grey or colour", info_.name);
    }
    if (picture.channels() == 3) {
      cv::cvtColor(picture, gray_, cv::COLOR_BGR2GRAY);
    } else {
      gray_ = picture;
    }
    frame_ = {
        .number = arrived_.number,
        .time_s = arrived_.time_s,
        .gray = {gray_.data, gray_.cols, gray_.rows, static_cast<std::ptrdiff_t>(gray_.step)}};
    return true;
  }

  ColorImage color() override {
    cv::Mat bgr = arrived_.picture;
    if (bgr.channels() == 1) cv::cvtColor(arrived_.picture, bgr, cv::COLOR_GRAY2BGR);
    ColorImage image{bgr.cols, bgr.rows, {}};
    const std::size_t row = 3 * static_cast<std::size_t>(bgr.cols);
    image.bgr.reserve(row * static_cast<std::size_t>(bgr.rows));
    for (int y = 0; y < bgr.rows; ++y)
      image.bgr.insert(image.bgr.end(), bgr.ptr(y), bgr.ptr(y) + row);
    return image;
  }

  std::int64_t damaged_frames() const override { return dropped_; }

 private:
  SourceInfo info_;
  std::shared_ptr<Shared> shared_;  // shared with the thread that reads, which may outlive this
  std::chrono::milliseconds patience_;
  Arrived arrived_;
  cv::Mat gray_;
  Frame frame_;
  std::int64_t dropped_ = 0;
};

}  // namespace

bool is_camera_word(std::string_view word) {
  return word.starts_with(kCamera) || word.starts_with(kOpenCv) ||
         word.find("://") != std::string_view::npos || word.find(" ! ") != std::string_view::npos;
}

Expected<std::unique_ptr<FrameSource>> open_camera(const std::string& word,
                                                   const CameraPatience& patience) {
  auto camera = camera_word(word);
  if (!camera) return Unexpected(camera.error());
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  const ImageSize wanted = camera->size;
  auto shared = std::make_shared<Shared>();
  std::thread([reader = std::make_shared<Reader>(std::move(*camera), shared)] {
    reader->run();
  }).detach();
  SourceInfo info;
  info.name = word;
  info.is_live = true;
  info.has_times = true;
  {
    std::unique_lock lock(shared->mutex);
    shared->changed.wait_for(lock, patience.opening,
                             [&] { return shared->is_open || shared->has_ended; });
    if (!shared->is_open) {
      shared->stop = true;
      if (!shared->complaint.empty()) return unreadable(shared->complaint, word);
      if (shared->has_ended) return unreadable("it opens, but gives no picture", word);
      return unreadable(fmt::format("no picture came within {} s of opening it",
                                    std::chrono::duration<double>(patience.opening).count()),
                        word);
    }
    info.size = shared->size;
    info.frame_rate = shared->frame_rate;
  }
  auto source = std::make_unique<LiveCamera>(info, shared, patience.frame);
  if (wanted.width > 0 && !(wanted == info.size)) {
    return unreadable(fmt::format("it gives {} x {} pixels, not {} x {}", info.size.width,
                                  info.size.height, wanted.width, wanted.height),
                      word);
  }
  return source;
}

}  // namespace swarmsmith
