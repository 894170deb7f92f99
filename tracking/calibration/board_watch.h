#pragma once

#include <array>
#include <optional>
#include <vector>

#include "tracking/calibration/find_board.h"

namespace swarmsmith {

/// The progress of collecting views of a board in front of a camera.
struct BoardProgress {
  bool is_seen = false;  ///< in the last picture that was searched
  int views = 0;         ///< number of different views
  std::array<int, 9> ninths{};
  double coverage = 0;
};

/// Watches a board that is held in front of a camera while it films. Chooses views in the same way
/// as `calibrate camera` does from a video.
class BoardWatch {
 public:
  explicit BoardWatch(Board board);

  /// Searches a picture twice per second, because finding a board takes longer than finding robots,
  /// and people move it slowly.
  BoardProgress look_at(const GrayImage& image, double time_s);

 private:
  Board board_;
  std::vector<BoardSight> sights_;
  std::optional<double> searched_s_;
  BoardProgress progress_;
};

}  // namespace swarmsmith
