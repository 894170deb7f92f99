#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "base/expected.h"
#include "sim/mission/mission.h"
#include "tracking/geometry/view.h"
#include "tracking/video/frame_source.h"

namespace swarmsmith {

/// Measures the colours of the patches of a run in pictures of its floor.

/// A picture of the floor, before the start of a run or during it.
struct FloorPicture {
  View view;
  ColorImage image;
  std::vector<Point> robots;  ///< positions of the robots in it, as far as known
};

/// The patch on one of the mission's places.
struct MeasuredPatch {
  Rectangle place;
  Rgb color;                      ///< a colour of the mission, or the floor's colour
  double confidence = 0;          ///< 0: two colours fit equally well; 1: only one fits
  std::array<double, 3> ratio{};  ///< red, green, blue divided by the floor's values nearby
  int pictures = 0;               ///< number of pictures in which it was seen
};

struct MeasuredLayout {
  std::vector<MeasuredPatch> places;  ///< in the mission's order

  /// The patches in the form that run_patches accepts, without bare places.
  std::vector<Patch> patches(const Arena& arena) const;
};

/// Measures the colour of each of the mission's places: the median within the place divided by the
/// median of the floor around it, which cancels light, vignetting and white balance; then the
/// median over all pictures; then the nearest of the mission's colours. Parts that a robot hides
/// from the camera are left out. With several pictures, of one camera or several, before the start
/// and during the run, the robots have moved between them.
///
/// E_LAYOUT_MISSING, with the measured colours, if a place is in no picture or always hidden, if
/// its colour matches no colour of the mission or two of them, or if the number of patches of a
/// colour is not the mission's; also if the floor is too dark or overexposed. E_CONFIG for a
/// mission without places.
Expected<MeasuredLayout> measure_layout(std::span<const FloorPicture> pictures,
                                        const Mission& mission);

}  // namespace swarmsmith
