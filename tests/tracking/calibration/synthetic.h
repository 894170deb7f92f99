#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "base/math.h"
#include "base/rng.h"
#include "tests/support/overhead_camera.h"
#include "tracking/calibration/board.h"
#include "tracking/calibration/solve_camera.h"
#include "tracking/calibration/solve_place.h"
#include "tracking/geometry/tag_pose.h"

namespace swarmsmith {

/// How a board is held.
struct Holding {
  double most_tilt_rad = 40 * kPi / 180;
  double nearest_m = 0.25;  ///< of the board's middle, for a focal length of 1015 px
  double farthest_m = 0.6;
  double noise_px = 0.05;
};

/// A board before a camera as a person holds it: aimed at a place of the picture, tilted, near
/// enough to fill a sixth to a half of it; corners outside of the picture are not seen.
inline BoardView held_board(const CameraModel& camera, const Board& board, Rng rng,
                            const Holding& holding) {
  const double tilt = holding.most_tilt_rad;
  const double depth = rng.uniform(holding.nearest_m, holding.farthest_m) * camera.fx / 1015;
  const ImagePoint aim{rng.uniform(0.12, 0.88) * camera.size.width,
                       rng.uniform(0.12, 0.88) * camera.size.height};
  const Ray ray = rays_of(camera, std::vector<ImagePoint>{aim}).front();
  CameraPlace place;
  // Half a turn about x, since the board's y is turned as well below.
  // Compilers evaluate arguments in orders of their own.
  const double turn = rng.uniform(-0.5, 0.5);
  const double roll = rng.uniform(-tilt, tilt);
  const double pitch = rng.uniform(-tilt, tilt);
  place.rotation = rotation_about(std::numbers::pi + pitch, roll, turn);
  const Point3 middle = place.seen_from_camera({board.width_m() / 2, board.height_m() / 2, 0});
  place.translation = {ray.x * depth - middle.x, ray.y * depth - middle.y, depth - middle.z};
  BoardView view;
  for (const Point& corner : corners_of(board)) {
    const Point3 seen = place.seen_from_camera({corner.x, board.height_m() - corner.y, 0});
    if (seen.z < 0.05 || std::hypot(seen.x, seen.y) > 1.25 * seen.z) continue;
    ImagePoint pixel = image_of(camera, seen);
    pixel.u += rng.normal(0, holding.noise_px);
    pixel.v += rng.normal(0, holding.noise_px);
    if (pixel.u < 3 || pixel.v < 3 || pixel.u > camera.size.width - 4 ||
        pixel.v > camera.size.height - 4) {
      continue;
    }
    view.board.push_back(corner);
    view.seen.push_back(pixel);
  }
  return view;
}

inline std::vector<BoardView> held_boards(const CameraModel& camera, int count, std::uint64_t seed,
                                          const Holding& holding = {}) {
  const Board board = *parse_board("charuco:11x8:0.03:0.022:5x5_100");
  std::vector<BoardView> views;
  for (std::uint64_t i = 0; static_cast<int>(views.size()) < count; ++i) {
    BoardView view = held_board(camera, board, Rng(seed).split("view", i), holding);
    if (view.seen.size() < 12) continue;
    view.name = "view" + std::to_string(views.size()) + ".png";
    views.push_back(std::move(view));
  }
  return views;
}

/// 2.7 m above the floor, tilted by 3 and 2 degrees.
inline View laboratory() {
  View view{wide_camera(), {rotation_about(std::numbers::pi + 0.052, 0.035, 0.4), {}}};
  const Point3 centre = view.place.seen_from_camera({0.06, -0.04, 2.7});
  view.place.translation = {-centre.x, -centre.y, -centre.z};
  return view;
}

/// Six floor tags near the walls.
inline std::vector<ReferenceTag> floor_tags() {
  std::vector<ReferenceTag> tags;
  for (int i = 0; i < 6; ++i) {
    const double angle = i * std::numbers::pi / 3 + 0.2;
    tags.push_back({100 + i, {1.08 * std::cos(angle), 1.08 * std::sin(angle), 0.7 * i - 2}, 0.1});
  }
  return tags;
}

/// The same with noise.
inline TagCorners seen_corners(const View& view, const Pose& pose, double edge_m, double height_m,
                               Rng& rng, double noise_px) {
  TagCorners corners = seen_corners(view, pose, edge_m, height_m);
  for (ImagePoint& corner : corners) {
    corner.u += rng.normal(0, noise_px);
    corner.v += rng.normal(0, noise_px);
  }
  return corners;
}

inline std::vector<SeenTag> seen_floor(const View& view, double noise_px, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<SeenTag> seen;
  for (const ReferenceTag& tag : floor_tags())
    seen.push_back({tag, seen_corners(view, tag.pose, tag.edge_m, 0, rng, noise_px)});
  return seen;
}

}  // namespace swarmsmith
