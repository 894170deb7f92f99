#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <opencv2/core/mat.hpp>
#include <string>
#include <thread>

#include "tracking/video/internal/camera_word.h"

namespace swarmsmith {

/// A picture and when it was taken, seconds of the machine's monotonic clock.
struct Arrived {
  cv::Mat picture;
  double time_s = 0;
  std::int64_t number = 0;
};

/// What the thread that reads a camera and the thread that tracks have in common.
struct CameraQueue {
  std::mutex mutex;
  std::condition_variable changed;
  std::deque<Arrived> queue;
  bool is_open = false;
  bool has_ended = false;  ///< or could not be opened
  std::string complaint;   ///< why; empty: no more pictures
  bool stop = false;       ///< no more is wanted
  ImageSize size;
  double frame_rate = 0;
  std::int64_t dropped = 0;  ///< that were not fetched in time
};

/// A thread that opens a camera and fills the queue, until this is destroyed. A driver or a network
/// can hold the thread for ever. It is then left behind, and the process ends without destructors:
/// those of the globals of OpenCV and FFmpeg must not run beside it.
class CameraReader {
 public:
  CameraReader(CameraWord word, std::shared_ptr<CameraQueue> queue);
  CameraReader(const CameraReader&) = delete;
  CameraReader& operator=(const CameraReader&) = delete;
  ~CameraReader();

 private:
  std::shared_ptr<CameraQueue> queue_;
  std::thread thread_;
};

}  // namespace swarmsmith
