#include "sim/engine/internal/places.h"

namespace swarmsmith {
namespace {

/// Maximum number of cells per side: a swarm with one mover per cell fills a square of 64 x 64 with
/// 4,096.
constexpr double kMostCells = 64;
/// Larger than any rounding error, metres.
constexpr double kSlack_m = 1e-6;

}  // namespace

Places::Places(std::size_t movers) {
  if (movers <= kFew) return;
  cell_.resize(movers);
  sorted_.resize(movers);
  sorted_at_.resize(movers);
  list_.resize(movers + 1);
  end_.resize(movers);
  later_.resize(movers);
}

void Places::update(std::span<const Mover> movers) {
  if (movers.size() <= kFew || is_valid(movers)) return;
  made_at_.clear();
  for (const Mover& mover : movers)
    made_at_.push_back({mover.body.x, mover.body.y});
  lay_grid(movers);
  sort_into_cells();
  list_near();
}

/// False if a position is NaN.
bool Places::is_valid(std::span<const Mover> movers) const {
  bool valid = !made_at_.empty();
  for (std::size_t i = 0; i < made_at_.size(); ++i) {
    const double dx = movers[i].body.x - made_at_[i].x;
    const double dy = movers[i].body.y - made_at_[i].y;
    valid = valid && dx * dx + dy * dy <= kSkin_m * kSkin_m / 4;
  }
  return valid;
}

void Places::sort_into_cells() {
  begin_.assign(columns_ * rows_ + 1, 0);
  for (std::size_t i = 0; i < made_at_.size(); ++i) {
    cell_[i] = row_of(made_at_[i].y) * columns_ + column_of(made_at_[i].x);
    ++begin_[cell_[i]];
  }
  // Turns counts into ends; then the movers, in reverse order, move the ends down to the starts.
  for (std::size_t cell = 1; cell < begin_.size(); ++cell)
    begin_[cell] += begin_[cell - 1];
  for (std::size_t i = made_at_.size(); i-- > 0;) {
    const std::size_t place = --begin_[cell_[i]];
    sorted_[place] = i;
    sorted_at_[place] = made_at_[i];
  }
}

void Places::list_near() {
  constexpr double kReach_m = kListed_m + kSkin_m + kSlack_m;
  // Each mover is written, but counted only if it is near: which movers are near is unpredictable.
  std::size_t count = 0;
  for (std::size_t i = 0; i < made_at_.size(); ++i) {
    list_[i] = count;
    const Point self = made_at_[i];
    for_cells(self, kReach_m, [&](std::size_t begin, std::size_t end) {
      if (found_.size() < count + (end - begin)) found_.resize(2 * (count + (end - begin)));
      for (std::size_t k = begin; k < end; ++k) {
        const double dx = sorted_at_[k].x - self.x;
        const double dy = sorted_at_[k].y - self.y;
        found_[count] = sorted_[k];
        count += static_cast<std::size_t>(dx * dx + dy * dy <= kReach_m * kReach_m) &
                 static_cast<std::size_t>(sorted_[k] != i);
      }
    });
  }
  list_.back() = count;
  if (near_.size() < count) near_.resize(found_.size());
  // Nearness is mutual: each mover is added to the lists of the movers on its list. These lists are
  // then ascending without sorting.
  std::copy(list_.begin(), list_.end() - 1, end_.begin());
  for (std::size_t i = 0; i < made_at_.size(); ++i) {
    later_[i] = end_[i];
    for (std::size_t k = list_[i]; k < list_[i + 1]; ++k)
      near_[end_[found_[k]]++] = i;
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
