#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "sim/mission/arena.h"
#include "tests/support/film/path.h"
#include "tracking/geometry/tag_pose.h"
#include "tracking/geometry/view.h"

/// A virtual camera for the tests of tracking: what stands before it as plain data, pictures and
/// the truth out. Same scene, same seed, same pixels.
namespace swarmsmith::film {

inline constexpr double kForever_s = std::numeric_limits<double>::infinity();

/// A tag that lies level at a fixed place.
struct FilmedTag {
  int tag = 0;
  Pose pose;  ///< of its middle; heading of its x axis
  double edge_m = 0.10;
  double height_m = 0;  ///< of its plane above the floor
  double from_s = -kForever_s;
  double until_s = kForever_s;

  bool always() const { return from_s == -kForever_s && until_s == kForever_s; }
};

/// A box with a tag on a plate.
struct FilmedRobot {
  int tag = 0;
  double edge_m = 0.10;
  double height_m = 0.20;  ///< of the plate
  TagOffset offset;
  Path path;             ///< of the robot's own centre
  double side_m = 0.20;  ///< of its square body, narrower than the model's for its bumpers
  double body_height_m = 0.11;
  int other_tag = 0;  ///< what it carries from `swap_s` on, as if a person swapped two
  double swap_s = kForever_s;
  double covered_from_s = kForever_s;  ///< white paper lies on its tag
  double covered_until_s = kForever_s;
};

/// An arm between the camera and the floor, for a while.
struct Arm {
  Point from;
  Point to;  ///< the hand
  double radius_m = 0.06;
  double height_m = 0.35;
  double from_s = 0;
  double until_s = 0;
};

/// A board with a pattern that is held before the camera.
struct FilmedBoard {
  int width = 0;  ///< of its picture
  int height = 0;
  std::vector<std::uint8_t> gray;  ///< row by row
  double pixel_m = 0;              ///< side of a pixel of the picture
  int margin_px = 0;               ///< of white around the pattern
  /// Of the board's frame into the camera's: x to the right and y down the picture, origin at the
  /// upper left corner of the pattern.
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};
  Point3 translation;
};

struct Scene {
  Arena arena;  ///< with the patches of the run
  std::string family = "tag36h11";
  std::vector<FilmedTag> tags;
  std::vector<FilmedRobot> robots;
  std::vector<Arm> arms;
  std::vector<FilmedBoard> boards;
};

/// How a camera sees, its faults included.
struct Shooting {
  View view;
  double exposure_s = 0;  ///< motion within it is blurred
  double readout_s = 0;   ///< first row to last
  double blur_px = 0.6;   ///< sigma of the lens' blur
  double noise = 2;       ///< sigma, grey levels
  double gain = 1;        ///< of the light
  double gradient = 0;    ///< light at the right edge minus that at the left one, over their mean
  double bump_s = kForever_s;  ///< from then on it hangs at `bumped`
  CameraPlace bumped;
};

/// Where the corners of a level tag's black border are seen, in the order of TagCorners.
TagCorners corners_of_tag(const View& view, const Pose& tag, double edge_m, double height_m);

/// A camera at `centre` that looks at a point of the floor, its image's upper edge towards +y,
/// turned by `roll_rad` about its axis.
CameraPlace looking_at(const Point3& centre, Point target, double roll_rad = 0);

}  // namespace swarmsmith::film
