#include "tracking/live/newest_frame.h"

#include <algorithm>
#include <utility>

namespace swarmsmith {
namespace {

using Clock = std::chrono::steady_clock;

/// The preview shows ten pictures per second.
constexpr std::chrono::milliseconds kColorEvery{95};

}  // namespace

NewestFrame::NewestFrame(FrameSource& source, OnFrame on_frame)
    : source_(&source), on_frame_(std::move(on_frame)), thread_([this] { run(); }) {}

NewestFrame::~NewestFrame() {
  {
    const std::scoped_lock lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

/// Waits until the time of a file's frame; returns whether to continue.
bool NewestFrame::wait_for_turn(double time_s) {
  std::unique_lock lock(mutex_);
  if (source_->info().is_live) return !stopping_;
  // A file is played at its own speed, so that its delays are those of a camera.
  const auto turn = *began_ + std::chrono::duration_cast<Clock::duration>(
                                  std::chrono::duration<double>(time_s - first_s_));
  return !changed_.wait_until(lock, turn, [this] { return stopping_; });
}

GrabbedFrame NewestFrame::grab(double time_s, Clock::time_point in) {
  const Frame& frame = source_->frame();
  GrabbedFrame grabbed{frame.number, time_s, {frame.gray.width, frame.gray.height}, {}, {}, in};
  const auto width = static_cast<std::size_t>(frame.gray.width);
  grabbed.gray.resize(width * static_cast<std::size_t>(frame.gray.height));
  for (int row = 0; row < frame.gray.height; ++row)
    std::copy_n(frame.gray.pixels + row * frame.gray.stride, width,
                &grabbed.gray[static_cast<std::size_t>(row) * width]);
  if (wants_color_ && (!last_color_.has_value() || in - *last_color_ >= kColorEvery)) {
    grabbed.color = source_->color();
    last_color_ = in;
  }
  return grabbed;
}

void NewestFrame::run() {
  std::optional<Error> error;
  while (true) {
    const auto more = source_->next();
    if (!more.has_value()) error = more.error();
    if (!more.has_value() || !*more) break;
    auto in = Clock::now();
    if (!began_.has_value()) {
      began_ = in;
      first_s_ = source_->frame().time_s.value_or(0);
    }
    const double time_s =
        source_->frame().time_s.value_or(std::chrono::duration<double>(in - *began_).count());
    if (!wait_for_turn(time_s)) break;
    // A file's frame was decoded earlier; a camera would deliver it only now.
    if (!source_->info().is_live) in = Clock::now();
    GrabbedFrame grabbed = grab(time_s, in);
    {
      const std::scoped_lock lock(mutex_);
      if (newest_.has_value()) {
        ++dropped_;
        // A client still waits for a picture with colours, so the next frame must have them.
        if (!grabbed.color.has_value()) last_color_.reset();
      }
      newest_ = std::move(grabbed);
      if (stopping_) break;
    }
    changed_.notify_all();
    if (on_frame_) {
      const auto written = on_frame_(*source_, time_s);
      if (!written.has_value()) error = written.error();
    }
    if (error.has_value()) break;
  }
  {
    const std::scoped_lock lock(mutex_);
    ended_ = true;
    error_ = std::move(error);
  }
  changed_.notify_all();
}

std::optional<GrabbedFrame> NewestFrame::take(std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, patience, [this] { return newest_.has_value() || ended_; });
  return std::exchange(newest_, std::nullopt);
}

bool NewestFrame::has_ended() const {
  const std::scoped_lock lock(mutex_);
  return ended_ && !newest_.has_value();
}

std::optional<Error> NewestFrame::error() const {
  const std::scoped_lock lock(mutex_);
  return error_;
}

}  // namespace swarmsmith
