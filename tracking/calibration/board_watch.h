#pragma once

#include <array>
#include <optional>
#include <vector>

#include "tracking/calibration/find_board.h"

namespace swarmsmith {

/// What the views so far of a board before the camera cover.
struct BoardProgress {
  bool is_seen = false;  ///< in the last picture that was searched
  int views = 0;         ///< that differ
  std::array<int, 9> ninths{};
  double coverage = 0;
};

/// Watches a board that is held before a camera as it films; makes the same choice of views as
/// `calibrate camera` makes of a video.
class BoardWatch {
 public:
  explicit BoardWatch(Board board);

  /// Searches a picture twice a second: a board takes longer to find than robots, and people move
  /// it slowly.
  BoardProgress look_at(const GrayImage& image, double time_s);

 private:
  Board board_;
  std::vector<BoardSight> sights_;
  std::optional<double> searched_s_;
  BoardProgress progress_;
};

}  // namespace swarmsmith
