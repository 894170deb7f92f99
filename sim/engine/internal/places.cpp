#include "sim/engine/internal/places.h"

namespace swarmsmith {
namespace {

/// Cells a side at most: a swarm of one mover a cell fills a square of 64 x 64 with 4,096.
constexpr double kMostCells = 64;
/// More than rounding takes or gives, metres.
constexpr double kSlack_m = 1e-6;

}  // namespace

Places::Places(std::size_t movers) {
  if (movers <= kFew) return;
  cell_.resize(movers);
  sorted_.resize(movers);
  near_.resize(movers);
}

void Places::update(std::span<const Mover> movers) {
  if (movers.size() <= kFew || is_valid(movers)) return;
  made_at_.clear();
  for (const Mover& mover : movers)
    made_at_.push_back({mover.body.x, mover.body.y});
  lay_grid(movers);
  sort_into_cells(movers);
  list_near(movers);
}

/// Not, with a place that is no number.
bool Places::is_valid(std::span<const Mover> movers) const {
  bool valid = !made_at_.empty();
  for (std::size_t i = 0; i < made_at_.size(); ++i) {
    const double dx = movers[i].body.x - made_at_[i].x;
    const double dy = movers[i].body.y - made_at_[i].y;
    valid = valid && dx * dx + dy * dy <= kSkin_m * kSkin_m / 4;
  }
  return valid;
}

void Places::sort_into_cells(std::span<const Mover> movers) {
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

void Places::list_near(std::span<const Mover> movers) {
  constexpr double kReach_m = kListed_m + kSkin_m + kSlack_m;
  for (std::vector<int>& near : near_)
    near.clear();
  // Each mover is added to the lists of the others, which are ascending then without being sorted.
  for (std::size_t i = 0; i < movers.size(); ++i) {
    const Body& self = movers[i].body;
    for_cells(self, kReach_m, [&](std::size_t other) {
      const bool is_near = distance2_of(self, movers[other].body) <= kReach_m * kReach_m;
      if (is_near && other != i) near_[other].push_back(static_cast<int>(i));
    });
  }
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
