#include "tracking/calibration/board_watch.h"

#include <utility>

namespace swarmsmith {

BoardWatch::BoardWatch(Board board) : board_(std::move(board)) {}

BoardProgress BoardWatch::look_at(const GrayImage& image, double time_s) {
  constexpr double kEvery_s = 0.5;
  constexpr std::size_t kMostViews = 200;
  if (searched_s_ && time_s - *searched_s_ < kEvery_s) return progress_;
  searched_s_ = time_s;
  auto sight = find_board(image, board_);
  progress_.is_seen = sight.has_value();
  if (!sight) return progress_;
  const ImageSize size{image.width, image.height};
  sights_.push_back(std::move(*sight));
  std::vector<BoardSight> kept;
  std::vector<ImagePoint> corners;
  for (const std::size_t i : pick_views(sights_, board_, size, kMostViews)) {
    kept.push_back(sights_[i]);
    corners.insert(corners.end(), kept.back().view.seen.begin(), kept.back().view.seen.end());
  }
  sights_ = std::move(kept);
  const FrameCoverage coverage = coverage_of(corners, size);
  progress_.views = static_cast<int>(sights_.size());
  progress_.ninths = coverage.ninths;
  progress_.coverage = coverage.share;
  return progress_;
}

}  // namespace swarmsmith
