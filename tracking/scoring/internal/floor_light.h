#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "tracking/scoring/measured_layout.h"

namespace swarmsmith {

/// Measures the brightness of the bare floor in a picture, and the colours of patches relative to
/// it.
class FloorLight {
 public:
  /// Samples the floor in a grid, except near the mission's places and patches, the walls and the
  /// robots. `picture` and `mission` must outlive this object.
  FloorLight(const FloorPicture& picture, const Mission& mission);

  /// The reason why the picture cannot be used for colours, if there is one.
  std::optional<std::string> fault() const;

  /// Median colour within the place divided by the median colour of the floor around it; nothing if
  /// the place is outside the picture or almost completely hidden.
  std::optional<std::array<double, 3>> ratio_of(const Rectangle& place) const;

 private:
  struct Spot {
    Point at;
    std::array<double, 3> rgb{};
  };

  bool is_hidden(Point point) const;
  std::optional<std::array<double, 3>> color_at(Point point) const;

  const FloorPicture& picture_;
  const Mission& mission_;
  Point3 camera_;
  std::vector<Spot> floor_;
};

}  // namespace swarmsmith
