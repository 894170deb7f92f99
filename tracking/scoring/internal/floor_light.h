#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "tracking/scoring/measured_layout.h"

namespace swarmsmith {

/// How bright the bare floor is in a picture, and its patches against it.
class FloorLight {
 public:
  /// Looks at the floor in a grid, beside the mission's places and patches, the walls and the
  /// robots. `picture` and `mission` must live as long as the light.
  FloorLight(const FloorPicture& picture, const Mission& mission);

  /// Why the picture says nothing of colours, if so.
  std::optional<std::string> fault() const;

  /// Medians within the place over those of the floor around it; nothing when it is out of the
  /// picture or nearly all hidden.
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
