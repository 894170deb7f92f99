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

/// Colours of the patches of a run, measured from pictures of its floor.

/// A picture of the floor, before the start of a run or within it.
struct FloorPicture {
  View view;
  ColorImage image;
  std::vector<Point> robots;  ///< where they stand in it, as far as is known
};

/// What lies on one of the mission's places.
struct MeasuredPatch {
  Rectangle place;
  Rgb color;                      ///< of the mission; its floor's where no patch lies
  double confidence = 0;          ///< 0: two colours fit alike; 1: one fits, and no other
  std::array<double, 3> ratio{};  ///< red, green, blue over those of the floor around
  int pictures = 0;               ///< that it was seen in
};

struct MeasuredLayout {
  std::vector<MeasuredPatch> places;  ///< in the mission's order

  /// As run_patches takes them; bare places left out.
  std::vector<Patch> patches(const Arena& arena) const;
};

/// Tells the colour of each of the mission's places: the median within it over that of the floor
/// around it, which takes out light, vignetting and white balance; then the median over the
/// pictures, and of the mission's colours the nearest. What a robot hides, as seen from the camera,
/// is left out. Several pictures, of one camera or of more, before the start and through the run,
/// let robots go elsewhere.
///
/// E_LAYOUT_MISSING, with what was seen, when a place is in no picture or always hidden, when its
/// colour is none of the mission's, or might be two of them, or when the colours' numbers are not
/// the mission's; also when the floor is too dark or overexposed. E_CONFIG for a mission without
/// places.
Expected<MeasuredLayout> measure_layout(std::span<const FloorPicture> pictures,
                                        const Mission& mission);

}  // namespace swarmsmith
