#pragma once

#include <vector>

#include "sim/engine/internal/world.h"

namespace swarmsmith {

/// Whether anything in the arena, or a robot, can block the line between two robots at the height
/// of their NeighbourSensor.
bool can_hide(const Arena& arena, const Robot& robot);

/// The visibility (or radio contact) of other robots from a robot, at the height of its
/// NeighbourSensor.
class Sight {
 public:
  /// `world` must outlive the object.
  Sight(const World& world, double wall_height_m);

  /// Whether nothing in this world is as high as the sensor, so that all robots see each other.
  bool is_clear() const { return clear_; }

  /// Whether the line between the centres of two robots crosses something as high as the sensor: a
  /// wall, an obstacle, an object or a third robot. `room` is working memory.
  bool is_hidden(int robot, int other, std::vector<int>& room) const;

 private:
  const World* world_;
  double height_m_;
  bool walls_hide_;
  bool obstacles_hide_;
  bool movers_hide_;
  bool clear_;
};

}  // namespace swarmsmith
