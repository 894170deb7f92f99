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

/// A picture and its time, in seconds of the machine's monotonic clock.
struct Arrived {
  cv::Mat picture;
  double time_s = 0;
  std::int64_t number = 0;
};

/// The data shared by the thread that reads a camera and the thread that tracks.
struct CameraQueue {
  std::mutex mutex;
  std::condition_variable changed;
  std::deque<Arrived> queue;
  bool is_open = false;
  bool has_ended = false;  ///< the camera has ended, or could not be opened
  std::string complaint;   ///< the reason; empty if there are no more pictures
  bool stop = false;       ///< the reader must stop
  ImageSize size;
  double frame_rate = 0;
  std::int64_t dropped = 0;  ///< pictures that were not fetched in time
};

/// A thread that opens a camera and fills the queue until this object is destroyed. A driver or a
/// network can block the thread for ever. In this case the thread is left running, and the process
/// ends without destructors, because the destructors of global objects in OpenCV and FFmpeg must
/// not run at the same time as the thread.
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
