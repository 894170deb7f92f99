#pragma once

#include <string>
#include <vector>

#include "sim/mission/arena.h"
#include "sim/mission/footprint.h"

namespace swarmsmith {

/// Who stands where in an arena, to find room for more.
class Ground {
 public:
  /// The arena's obstacles stand on it.
  explicit Ground(const Arena& arena);

  /// What keeps a solid from standing there: "a wall", "obstacle 1", "object 2", "robot 3" (counted
  /// from 1); empty when there is room.
  std::string blocked_by(const Footprint& solid) const;
  /// `name` as in "robot".
  void add(const Footprint& solid, std::string name);

  /// The smallest rectangle around the walls.
  Rectangle bounds() const;

 private:
  struct Standing {
    Footprint footprint;
    std::string name;
  };
  const Arena* arena_;
  std::vector<Point> corners_;
  std::vector<Standing> standing_;
};

}  // namespace swarmsmith
