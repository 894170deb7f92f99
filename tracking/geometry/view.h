#pragma once

#include <array>
#include <span>
#include <vector>

#include "sim/mission/pose.h"
#include "tracking/geometry/camera_model.h"

namespace swarmsmith {

/// The place of a camera: camera = rotation * world + translation.
struct CameraPlace {
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< row by row
  Point3 translation;

  Point3 centre() const;  ///< position of the camera in the world
  Point3 seen_from_camera(const Point3& world) const;

  friend bool operator==(const CameraPlace&, const CameraPlace&) = default;
};

/// A camera over the arena: everything that is needed to convert pixels to metres.
struct View {
  CameraModel camera;
  CameraPlace place;
};

/// The intersections of the rays of image points with the plane z = `height_m`, which must be below
/// the camera.
std::vector<Point> on_plane(const View& view, std::span<const ImagePoint> points, double height_m);

/// The image of a point in the world.
ImagePoint image_of(const View& view, const Point3& world);

}  // namespace swarmsmith
