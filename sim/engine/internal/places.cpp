#include "sim/engine/internal/places.h"

namespace swarmsmith {
namespace {

/// Cells a side at most: a swarm of one mover a cell fills a square of 64 x 64 with 4,096.
constexpr double kMostCells = 64;

}  // namespace

Places::Places(std::size_t movers) {
  if (movers <= kFew) return;
  cell_.resize(movers);
  sorted_.resize(movers);
}

void Places::update(std::span<const Mover> movers) {
  if (movers.size() <= kFew) return;
  lay_grid(movers);
  begin_.assign(columns_ * rows_ + 1, 0);
  for (std::size_t i = 0; i < movers.size(); ++i) {
    cell_[i] = row_of(movers[i].body.y) * columns_ + column_of(movers[i].body.x);
    ++begin_[cell_[i]];
  }
  // From counts to ends; then the movers, last first, push the ends down to the beginnings.
  for (std::size_t cell = 1; cell < begin_.size(); ++cell)
    begin_[cell] += begin_[cell - 1];
  for (std::size_t i = movers.size(); i-- > 0;)
    sorted_[--begin_[cell_[i]]] = i;
}

void Places::lay_grid(std::span<const Mover> movers) {
  left_m_ = bottom_m_ = kMostSound;
  double right = -kMostSound;
  double top = -kMostSound;
  for (const Mover& mover : movers) {
    left_m_ = std::min(left_m_, mover.body.x);
    bottom_m_ = std::min(bottom_m_, mover.body.y);
    right = std::max(right, mover.body.x);
    top = std::max(top, mover.body.y);
  }
  left_m_ = std::max(left_m_, -kMostSound);
  bottom_m_ = std::max(bottom_m_, -kMostSound);
  right = std::min(right, kMostSound);
  top = std::min(top, kMostSound);
  const double widest = std::max(right - left_m_, top - bottom_m_);
  cell_m_ = std::max(kCell_m, widest / kMostCells);
  columns_ = static_cast<std::size_t>(std::clamp((right - left_m_) / cell_m_, 0.0, kMostCells)) + 1;
  rows_ = static_cast<std::size_t>(std::clamp((top - bottom_m_) / cell_m_, 0.0, kMostCells)) + 1;
}

}  // namespace swarmsmith
