#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "sim/engine/internal/mover.h"

namespace swarmsmith {

inline double distance2_of(const Body& a, const Body& b) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  return dx * dx + dy * dy;
}

/// Where all movers are, to find what is near a place. A few are looked at one by one. Of
/// more, each has a list of those near it (Verlet, "Computer experiments on classical fluids I",
/// Phys. Rev. 159, 1967): it reaches a little further than is asked for, and holds until somebody
/// has moved half as far. Lists are made through a grid, so that their price is what is near and
/// not how many there are; so are answers about more than what they reach.
class Places {
 public:
  explicit Places(std::size_t movers);

  /// Takes the places as they are now; to be called whenever movers have moved.
  void update(std::span<const Mover> movers);

  /// Calls visit(other) for the movers with numbers from `first` on whose centres are at most
  /// `radius_m` from that of `mover`, ascending, without itself. `movers` are those of the last
  /// update; `room` is room to work in.
  template <class Visit>
  void visit_near(std::span<const Mover> movers, std::size_t mover, double radius_m,
                  std::size_t first, std::vector<int>& room, const Visit& visit) const {
    const Body& self = movers[mover].body;
    const double radius2 = radius_m * radius_m;
    const auto is_near = [&](std::size_t other) {
      return other >= first && other != mover && distance2_of(self, movers[other].body) <= radius2;
    };
    if (movers.size() <= kFew) {
      for (std::size_t other = first; other < movers.size(); ++other) {
        if (is_near(other)) visit(static_cast<int>(other));
      }
      return;
    }
    if (radius_m <= kListed_m) {
      const std::size_t end = list_[mover + 1];
      for (std::size_t i = first > mover ? later_[mover] : list_[mover]; i < end; ++i) {
        if (is_near(near_[i])) visit(static_cast<int>(near_[i]));
      }
      return;
    }
    room.clear();
    for_cells({self.x, self.y}, radius_m + kSkin_m, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (is_near(sorted_[i])) room.push_back(static_cast<int>(sorted_[i]));
      }
    });
    std::sort(room.begin(), room.end());
    for (const int other : room)
      visit(other);
  }

  /// Whether any two centres are at most `radius_m` apart.
  bool any_pair_near(std::span<const Mover> movers, double radius_m, std::vector<int>& room) const {
    bool any = false;
    if (movers.size() <= kFew) {  // all of them, without a branch for each
      const double radius2 = radius_m * radius_m;
      for (std::size_t i = 1; i < movers.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j)
          any |= distance2_of(movers[j].body, movers[i].body) <= radius2;
      }
      return any;
    }
    for (std::size_t i = 0; i < movers.size() && !any; ++i)
      visit_near(movers, i, radius_m, i + 1, room, [&](int) { any = true; });
    return any;
  }

 private:
  static constexpr std::size_t kFew = 16;
  /// What lists are for: about what sensors and contacts reach.
  static constexpr double kListed_m = 0.9;
  /// How much further lists reach, and how far two movers may come nearer to each other before
  /// lists and grid are made anew.
  static constexpr double kSkin_m = 0.3;
  static constexpr double kCell_m = 0.75;

  /// Calls take(begin, end) with what of `sorted_` is in the cells that a circle met when the grid
  /// was laid, row by row.
  template <class Take>
  void for_cells(const Point& centre, double radius_m, const Take& take) const {
    const std::size_t left = column_of(centre.x - radius_m);
    const std::size_t right = column_of(centre.x + radius_m);
    const std::size_t top = row_of(centre.y + radius_m);
    for (std::size_t row = row_of(centre.y - radius_m); row <= top; ++row)
      take(begin_[row * columns_ + left], begin_[row * columns_ + right + 1]);
  }

  std::size_t column_of(double x) const { return cell_of((x - left_m_) / cell_m_, columns_); }
  std::size_t row_of(double y) const { return cell_of((y - bottom_m_) / cell_m_, rows_); }
  /// NaN is put into the first cell.
  static std::size_t cell_of(double place, std::size_t cells) {
    if (!(place >= 1)) return 0;
    return place < static_cast<double>(cells) ? static_cast<std::size_t>(place) : cells - 1;
  }
  bool is_valid(std::span<const Mover> movers) const;
  void lay_grid(std::span<const Mover> movers);
  void sort_into_cells();
  void list_near();

  double left_m_ = 0;
  double bottom_m_ = 0;
  double cell_m_ = kCell_m;
  std::size_t columns_ = 1;
  std::size_t rows_ = 1;
  std::vector<std::size_t> cell_;    ///< of each mover
  std::vector<std::size_t> begin_;   ///< of each cell in `sorted_`, and the end of the last
  std::vector<std::size_t> sorted_;  ///< movers, cell by cell
  std::vector<Point> made_at_;       ///< where each mover was then
  std::vector<Point> sorted_at_;     ///< the same, cell by cell
  std::vector<std::size_t> found_;   ///< the lists, each in the order of cells
  std::vector<std::size_t> near_;    ///< the lists, one behind the other, each ascending
  std::vector<std::size_t> list_;    ///< where in them that of each mover begins; the end of all
  std::vector<std::size_t> end_;     ///< and where it ends so far
  std::vector<std::size_t> later_;   ///< and where in that those behind itself begin
};

}  // namespace swarmsmith
