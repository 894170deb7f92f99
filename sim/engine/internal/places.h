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

/// The positions of all movers, for finding the movers near a place. A small number of movers is
/// searched one by one. With more, each mover has a list of those near it (Verlet, "Computer
/// experiments on classical fluids I", Phys. Rev. 159, 1967). The list reaches a little farther
/// than needed, and stays valid until some mover has moved half the extra distance. A grid is used
/// to make the lists and to search beyond their reach, so that the cost depends on the number of
/// near movers, not on the total number.
class Places {
 public:
  explicit Places(std::size_t movers);

  /// Takes the present positions; must be called whenever movers have moved.
  void update(std::span<const Mover> movers);

  /// Calls visit(other) for the movers with index `first` or higher whose centres are at most
  /// `radius_m` from the centre of `mover`, in ascending order, except `mover` itself. `movers`
  /// must be the same as in the last update; `room` is working memory.
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
    if (movers.size() <= kFew) {  // checks all pairs, without a branch for each
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
  /// The radius that lists cover: about the reach of sensors and contacts.
  static constexpr double kListed_m = 0.9;
  /// The extra radius of the lists. Lists and grid are rebuilt before two movers have approached
  /// each other by more than this.
  static constexpr double kSkin_m = 0.3;
  static constexpr double kCell_m = 0.75;

  /// Calls take(begin, end) with the ranges of `sorted_` in the cells that overlap a circle, row by
  /// row; cells hold the positions from when the grid was made.
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
  std::vector<std::size_t> cell_;    ///< cell of each mover
  std::vector<std::size_t> begin_;   ///< start of each cell in `sorted_`, and the end of the last
                                     ///< cell
  std::vector<std::size_t> sorted_;  ///< movers, cell by cell
  std::vector<Point> made_at_;       ///< position of each mover when the grid was made
  std::vector<Point> sorted_at_;     ///< the same, cell by cell
  std::vector<std::size_t> found_;   ///< the lists, each in the order of cells
  std::vector<std::size_t> near_;    ///< the lists, one after another, each ascending
  std::vector<std::size_t> list_;    ///< start of each mover's list, and the end of the last list
  std::vector<std::size_t> end_;     ///< end of each mover's list while lists are filled
  std::vector<std::size_t> later_;   ///< position in each mover's list of the first mover with a
                                     ///< higher index
};

}  // namespace swarmsmith
