#pragma once

#include <array>
#include <span>
#include <vector>

namespace swarmsmith {

/// A position in an image, in pixels; u to the right, v down. Integers are the centres of pixels,
/// as in OpenCV; the apriltag library adds 0.5.
struct ImagePoint {
  double u = 0;
  double v = 0;

  friend bool operator==(const ImagePoint&, const ImagePoint&) = default;
};

struct ImageSize {
  int width = 0;
  int height = 0;

  friend bool operator==(const ImageSize&, const ImageSize&) = default;
};

/// A point in the world or in a camera's frame, in metres. World: origin at the arena's centre on
/// the floor, z up. Camera: x right, y down, z forward.
struct Point3 {
  double x = 0;
  double y = 0;
  double z = 0;

  friend bool operator==(const Point3&, const Point3&) = default;
};

/// The model of a lens's distortion. Pinhole: Brown's model (D. C. Brown, "Close-range camera
/// calibration", 1971) with k1, k2, p1, p2, k3. Fisheye: Kannala and Brandt (PAMI 28, 2006) with k1
/// to k4, for lenses of more than about 100 degrees.
enum class Lens { Pinhole, Fisheye };

/// The intrinsic parameters of a camera, which depend on its focus and zoom. Valid for one image
/// size.
struct CameraModel {
  ImageSize size;
  Lens lens = Lens::Pinhole;
  double fx = 0;  ///< focal lengths and principal point, pixels
  double fy = 0;
  double cx = 0;
  double cy = 0;
  std::array<double, 5> distortion{};  ///< in OpenCV's order; for a fisheye lens the fifth is 0

  friend bool operator==(const CameraModel&, const CameraModel&) = default;
};

/// A ray from the camera through (x, y, 1) of its frame.
struct Ray {
  double x = 0;
  double y = 0;
};

/// The rays of image points, converged to below 1e-6 pixels even in the corners.
std::vector<Ray> rays_of(const CameraModel& camera, std::span<const ImagePoint> points);

/// The image of a point in the camera's frame; its z must be positive.
ImagePoint image_of(const CameraModel& camera, const Point3& point);

/// Whether a ray at a larger angle always has an image farther out, up to the image's corners.
/// Otherwise the model folds and cannot be inverted.
bool is_monotonic(const CameraModel& camera);

}  // namespace swarmsmith
