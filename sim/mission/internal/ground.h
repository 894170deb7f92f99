#pragma once

#include <string>
#include <vector>

#include "sim/mission/arena.h"
#include "sim/mission/footprint.h"

namespace swarmsmith {

/// The solids in an arena, used to find room for more.
class Ground {
 public:
  /// Begins with the obstacles of the arena, unless they do not count.
  explicit Ground(const Arena& arena, bool ignores_obstacles = false);

  /// The thing that keeps a solid from being placed there: "a wall", "obstacle 1", "object 2",
  /// "robot 3" (counted from 1); empty when there is room.
  std::string blocked_by(const Footprint& solid) const;
  /// Adds a solid; `name` is a name such as "robot 1".
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
