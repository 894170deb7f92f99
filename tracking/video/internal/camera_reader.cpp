#include "tracking/video/internal/camera_reader.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/core/version.hpp>
#include <opencv2/videoio.hpp>
#include <optional>
#include <utility>

#include "tracking/video/internal/picture.h"

namespace swarmsmith {
namespace {

using Clock = std::chrono::steady_clock;

/// The library is loaded when a camera is opened (cmake/LateLibraries.cmake); an archive made by
/// packaging/bundle does not contain it.
bool has_videoio() {
  const std::string name =
      fmt::format("libopencv_videoio.so.{}{:02}", CV_VERSION_MAJOR, CV_VERSION_MINOR);
  return dlopen(name.c_str(), RTLD_LAZY) != nullptr;
}

class Reading {
 public:
  Reading(CameraWord word, std::shared_ptr<CameraQueue> shared)
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
  /// Returns the reason why the camera ended; empty if there are no more pictures.
  std::string read_all() {
    if (!has_videoio()) {
      return "live cameras need OpenCV's library videoio, which is missing here: the archive of "
             "this program does not include it, the Debian package installs it";
    }
    camera_.emplace();
    if (!open()) return "OpenCV cannot open it; is it connected, and not in use?";
    has_driver_times_ = camera_->getBackendName() == "V4L2";
    rate_ = camera_->get(cv::CAP_PROP_FPS);
    constexpr double kMostRate = 1000;
    if (!(rate_ > 0 && rate_ <= kMostRate)) rate_ = 0;
    const Clock::time_point start = Clock::now();
    for (std::int64_t number = 0;; ++number) {
      cv::Mat picture;
      if (!camera_->read(picture) || picture.empty()) return {};
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

  /// Each backend is named; otherwise OpenCV tries all of them in turn, including those for photo
  /// and FireWire cameras, which search all USB devices.
  bool open() {
    if (!word_.index) {
      return std::ranges::any_of(
          std::array{cv::CAP_FFMPEG, cv::CAP_GSTREAMER, cv::CAP_V4L2, cv::CAP_IMAGES},
          [&](int backend) { return is_wanted() && camera_->open(word_.address, backend); });
    }
    if (!camera_->open(*word_.index, cv::CAP_V4L2)) return false;
    if (word_.size.width > 0) {
      // Raw pictures of this size usually exceed the bandwidth of USB.
      camera_->set(cv::CAP_PROP_FOURCC, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'));
      camera_->set(cv::CAP_PROP_FRAME_WIDTH, word_.size.width);
      camera_->set(cv::CAP_PROP_FRAME_HEIGHT, word_.size.height);
    }
    if (word_.frame_rate > 0) camera_->set(cv::CAP_PROP_FPS, word_.frame_rate);
    return true;
  }

  bool is_wanted() {
    const std::scoped_lock lock(shared_->mutex);
    return !shared_->stop;
  }

  double time_of_picture() {
    const double now = std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
    constexpr double kMilliseconds = 1e-3;
    if (has_driver_times_) {
      const double driver = camera_->get(cv::CAP_PROP_POS_MSEC) * kMilliseconds;
      if (driver > 0) return driver;
      has_driver_times_ = false;
    }
    return rate_ > 0 ? now - 0.5 / rate_ : now;
  }

  /// False if the reader must stop.
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
  std::shared_ptr<CameraQueue> shared_;     // shared, since this thread may outlive its creator
  std::optional<cv::VideoCapture> camera_;  // none until the library is known to exist
  bool has_driver_times_ = false;
  double rate_ = 0;
};

/// Registers the handler now, so that it runs before all handlers registered earlier.
void end_without_destructors() {
  on_exit(
      [](int status, void*) {
        std::fflush(nullptr);
        _exit(status);
      },
      nullptr);
}

}  // namespace

CameraReader::CameraReader(CameraWord word, std::shared_ptr<CameraQueue> queue)
    : queue_(std::move(queue)) {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  thread_ = std::thread(
      [reading = std::make_unique<Reading>(std::move(word), queue_)] { reading->run(); });
}

CameraReader::~CameraReader() {
  constexpr std::chrono::milliseconds kPatience{200};
  std::unique_lock lock(queue_->mutex);
  queue_->stop = true;
  const bool has_ended =
      queue_->changed.wait_for(lock, kPatience, [&] { return queue_->has_ended; });
  lock.unlock();
  if (has_ended) {
    thread_.join();
    return;
  }
  thread_.detach();
  end_without_destructors();
}

}  // namespace swarmsmith
