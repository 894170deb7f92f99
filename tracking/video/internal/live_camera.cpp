#include "tracking/video/internal/live_camera.h"

#include <fmt/format.h>

#include <opencv2/imgproc.hpp>
#include <utility>

#include "tracking/video/internal/camera_reader.h"
#include "tracking/video/internal/unreadable.h"

namespace swarmsmith {
namespace {

class LiveCamera final : public FrameSource {
 public:
  LiveCamera(SourceInfo info, std::unique_ptr<CameraReader> reader,
             std::shared_ptr<CameraQueue> shared, std::chrono::milliseconds patience)
      : info_(std::move(info)),
        shared_(std::move(shared)),
        reader_(std::move(reader)),
        patience_(patience) {}

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
  std::shared_ptr<CameraQueue> shared_;  // shared with the reading thread, which may outlive this
                                         // object
  std::unique_ptr<CameraReader> reader_;
  std::chrono::milliseconds patience_;
  Arrived arrived_;
  cv::Mat gray_;
  Frame frame_;
  std::int64_t dropped_ = 0;
};

}  // namespace

Expected<std::unique_ptr<FrameSource>> open_camera(const std::string& word,
                                                   const CameraPatience& patience) {
  auto camera = camera_word(word);
  if (!camera) return Unexpected(camera.error());
  const ImageSize wanted = camera->size;
  auto shared = std::make_shared<CameraQueue>();
  auto reader = std::make_unique<CameraReader>(std::move(*camera), shared);
  SourceInfo info;
  info.name = word;
  info.is_live = true;
  info.has_times = true;
  {
    std::unique_lock lock(shared->mutex);
    shared->changed.wait_for(lock, patience.opening,
                             [&] { return shared->is_open || shared->has_ended; });
    if (!shared->is_open) {
      if (!shared->complaint.empty()) return unreadable(shared->complaint, word);
      if (shared->has_ended) return unreadable("it opens, but gives no picture", word);
      return unreadable(fmt::format("no picture came within {} s of opening it",
                                    std::chrono::duration<double>(patience.opening).count()),
                        word);
    }
    info.size = shared->size;
    info.frame_rate = shared->frame_rate;
  }
  auto source = std::make_unique<LiveCamera>(info, std::move(reader), shared, patience.frame);
  if (wanted.width > 0 && !(wanted == info.size)) {
    return unreadable(fmt::format("it gives {} x {} pixels, not {} x {}", info.size.width,
                                  info.size.height, wanted.width, wanted.height),
                      word);
  }
  return source;
}

}  // namespace swarmsmith
