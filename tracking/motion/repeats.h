#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "tracking/observing/observations.h"
#include "tracking/rig/rig.h"

namespace swarmsmith {

/// No corner of an RVR's tag is faster: treads reach 0.35 m/s, and turning adds as much again.
inline constexpr double kCornerSpeed_m_s = 0.7;

/// A period on a camera's clock.
struct ClockSpan {
  double from_s = 0;
  double to_s = 0;
  bool is_loop = false;  ///< several pictures repeat in a loop, instead of one picture
};

/// Frames of one camera that repeat the picture before them. Recorders write such frames when they
/// hang, or when more frames are requested than the camera delivers. They are not samples.
struct Repeats {
  std::vector<bool> again;        ///< per frame: it is a repeat
  std::size_t count = 0;          ///< number of repeats
  std::vector<ClockSpan> frozen;  ///< long repeats, from the last true picture to the last repeat
  /// The film stands still from this time to its end, and it is unknown whether the robots do, too.
  std::optional<double> doubtful_from_s;
};

/// Compares the corners of robots' tags, because codecs write the same picture with different bits.
/// A picture is a repeat if robots that moved before stand still in it and move on afterwards, and
/// - for a few frames: two or more robots stand, or a single one that jumps afterwards;
/// - for longer: they make up for it in one step; or, at the film's end, the camera noise vanishes
///   that moved the corners of still tags before; or, if this cannot be seen, two or more robots
///   stop in the same frame, each after a full step. A single robot that stops like this is
///   doubtful.
/// If all robots return together to a place where they were shortly before, for three pictures or
/// more, the recorder repeats several pictures in a loop. A film in which nothing moves before and
/// after is not a repeat, since its robots really are where it shows them. But its end is doubtful
/// if no corner changes by a thousandth of a pixel any more, and it is unknown whether the codec
/// hides noise.
Repeats repeats_of(const Observations& observations, int camera, std::span<const RobotSetup> robots,
                   double corner_speed_m_s = kCornerSpeed_m_s);

}  // namespace swarmsmith
