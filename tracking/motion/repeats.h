#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "tracking/observing/observations.h"
#include "tracking/rig/rig.h"

namespace swarmsmith {

/// From when to when, on a camera's clock.
struct ClockSpan {
  double from_s = 0;
  double to_s = 0;
  bool is_loop = false;  ///< some pictures over and over, in place of one
};

/// Frames of one camera that show the picture before once more, as recorders write them that hang,
/// or that are asked for more frames than the camera has. They are not samples.
struct Repeats {
  std::vector<bool> again;        ///< one a frame
  std::size_t count = 0;          ///< of them
  std::vector<ClockSpan> frozen;  ///< longer holds, from the last true picture to the last repeat
  /// From when on the film stands still to its end, and nothing tells whether robots do, too.
  std::optional<double> doubtful_from_s;
};

/// By the corners of robots' tags, since codecs write the same picture with other bits. A picture
/// is a repeat where robots stand that moved before and move on afterwards, and
/// - for a few frames: all that move stand, or the only one that moves then makes up for it;
/// - for longer: they make up for it in one step; or, at the film's end, the camera's noise is gone
///   that moved the corners of still tags before; or, where that cannot be told, two or more stop
///   dead in one frame, each after a full step. One robot that does so is doubtful.
/// Where robots come back, all at once and for three pictures or more, to where they were shortly
/// before, the recorder repeats a few pictures.
/// A film in which nothing moves before and after is not a repeat: its robots are where it shows
/// them, but at its end it is doubtful when no corner differs by a thousandth of a pixel any more,
/// and nothing tells whether the codec hides noise.
Repeats repeats_of(const Observations& observations, int camera,
                   std::span<const RobotSetup> robots);

}  // namespace swarmsmith
