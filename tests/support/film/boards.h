#pragma once

#include <vector>

#include "base/rng.h"
#include "tests/support/film/scene.h"

namespace swarmsmith::film {

/// What is printed on a calibration board. A chessboard has no markers.
struct BoardKind {
  bool charuco = true;
  int columns = 9;  ///< squares
  int rows = 6;
  double square_m = 0.040;
  double marker_m = 0.030;
  int dictionary = 0;  ///< of OpenCV; 0 is DICT_4X4_50

  double width_m() const { return columns * square_m; }
  double height_m() const { return rows * square_m; }
};

/// The board's picture with a margin of half a square; the origin of its frame is the upper left
/// corner of the first square, so that `translation` of a pose is that corner's.
FilmedBoard board_of(const BoardKind& kind);

/// Inner corners, row by row, in the board's frame.
std::vector<Point> inner_corners(const BoardKind& kind);

/// A board at a place: its middle is seen at `middle` of the image, `distance_m` away along the
/// axis, turned about its own axes by the angles in order x, y, z.
FilmedBoard held(const FilmedBoard& board, const BoardKind& kind, const CameraModel& camera,
                 ImagePoint middle, double distance_m, double tilt_x, double tilt_y, double turn);

/// A board's point in the image.
ImagePoint image_of_board(const FilmedBoard& board, const CameraModel& camera, Point point);

/// Views as a person makes them who was told how: all nine thirds of the image, tilts to 40
/// degrees, a sixth to a half of the frame.
std::vector<FilmedBoard> calibration_views(const BoardKind& kind, const CameraModel& camera,
                                           int count, Rng rng);

}  // namespace swarmsmith::film
