#pragma once

#include <vector>

#include "tracking/geometry/view.h"

namespace swarmsmith::film {

/// The ray of every pixel's middle, row by row: the lens undone once.
struct LensMap {
  ImageSize size;
  std::vector<Ray> rays;

  const Ray& at(int u, int v) const {
    return rays[static_cast<std::size_t>(v) * static_cast<std::size_t>(size.width) +
                static_cast<std::size_t>(u)];
  }
};

LensMap lens_map_of(const CameraModel& camera);

/// A place on a plane, and how it changes from pixel to pixel.
struct Footprint {
  float x = 0;
  float y = 0;
  float x_u = 0;  ///< change of x towards the next column
  float y_u = 0;
  float x_v = 0;  ///< towards the next row
  float y_v = 0;
};

/// Where each pixel's ray meets the floor. Other level planes follow from it: the point at height z
/// lies z / camera height of the way from the floor's point to the point below the camera.
class FloorMap {
 public:
  FloorMap(const LensMap& lens, const CameraPlace& place);

  Footprint at(int u, int v) const;
  const Point3& camera() const { return camera_; }
  ImageSize size() const { return size_; }

 private:
  struct Spot {
    float x, y;
  };
  const Spot& spot(int u, int v) const {
    return spots_[static_cast<std::size_t>(v) * static_cast<std::size_t>(size_.width) +
                  static_cast<std::size_t>(u)];
  }

  ImageSize size_;
  Point3 camera_;
  std::vector<Spot> spots_;
};

}  // namespace swarmsmith::film
