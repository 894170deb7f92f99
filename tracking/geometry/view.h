#pragma once

#include <array>
#include <span>
#include <vector>

#include "sim/mission/pose.h"
#include "tracking/geometry/camera_model.h"

namespace swarmsmith {

/// Where a camera hangs: camera = rotation * world + translation.
struct CameraPlace {
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< row by row
  Point3 translation;

  Point3 centre() const;  ///< of the camera, in the world
  Point3 seen_from_camera(const Point3& world) const;

  friend bool operator==(const CameraPlace&, const CameraPlace&) = default;
};

/// A camera over the arena: all that it takes to come from pixels to metres.
struct View {
  CameraModel camera;
  CameraPlace place;
};

/// Where the rays of image points meet the plane z = `height_m`, which must be below the camera.
std::vector<Point> on_plane(const View& view, std::span<const ImagePoint> points, double height_m);

/// Where a point of the world is seen.
ImagePoint image_of(const View& view, const Point3& world);

}  // namespace swarmsmith
