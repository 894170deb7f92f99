#pragma once

#include <string>
#include <vector>

#include "base/rng.h"

namespace swarmsmith::film {

/// From when to when, seconds.
struct Stretch {
  double from_s = 0;
  double until_s = 0;
};

/// When frames are taken, and what the camera says about it.
struct Schedule {
  double from_s = 0;   ///< true time of the first frame
  double until_s = 0;  ///< of the last one, about
  double rate_hz = 15;
  double jitter_s = 0;         ///< sigma of when a frame is taken about its turn
  double drop_share = 0;       ///< of frames that never arrive, at random
  std::vector<Stretch> drops;  ///< no frame arrives in these
  double twice_share = 0;      ///< of frames that show the picture before once more
  bool counts_frames = false;  ///< stamps are frame / rate, whatever was dropped
  double clock_ahead_s = 0;    ///< the camera's clock minus the true one
};

struct ShotFrame {
  double true_s = 0;         ///< when the picture was taken
  double stamp_s = 0;        ///< on the camera's clock
  std::int64_t picture = 0;  ///< its number; that of the frame before when it is shown twice
};

/// The first and the last frame always arrive, so that a clip covers what it shall.
std::vector<ShotFrame> frames_of(const Schedule& schedule, Rng rng);

/// Frames when another program's sidecar has them, by its column `clock_s`, on which the run starts
/// at `start_clock_s`. Throws std::runtime_error when it is none.
std::vector<ShotFrame> frames_of_clock(const std::string& sidecar, double start_clock_s);

/// The sidecar: columns frame and time_s.
std::string frame_times_csv(const std::vector<ShotFrame>& frames);

}  // namespace swarmsmith::film
