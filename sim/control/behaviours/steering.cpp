#include "sim/control/behaviours/steering.h"

#include <algorithm>
#include <cmath>

namespace swarmsmith {

UsedSenses senses_of_avoidance(const Flavour& flavour) {
  return {.proximity = true, .neighbours = flavour.obstacles.neighbours_as_obstacles};
}

std::span<const Neighbour> neighbours_in_the_way(Senses& senses, const ObstacleModel& model) {
  return model.neighbours_as_obstacles ? senses.neighbours() : std::span<const Neighbour>{};
}

Command steer(double gain, const std::optional<Vector2>& target, double obstacle_gain,
              Senses& senses, const Flavour& flavour) {
  const SteeringModel& model = flavour.steering;
  const Vector2 otherwise{model.forward_by_default ? 1.0 : 0.0, 0};
  const Vector2 wanted = target.value_or(otherwise);
  const Vector2 obstacles = obstacle_vector(
      senses.proximity(), neighbours_in_the_way(senses, flavour.obstacles), flavour.obstacles);
  Vector2 result{gain * wanted.x - obstacle_gain * obstacles.x,
                 gain * wanted.y - obstacle_gain * obstacles.y};
  const double square = result.x * result.x + result.y * result.y;
  if (square < model.shortest_result * model.shortest_result) result = {1, 0};
  return command_towards(result.x, result.y, flavour.speed_mps, model.least_inner);
}

Command follow_neighbours(double gain, double weight, double obstacle_gain, Senses& senses,
                          const Flavour& flavour) {
  const NeighbourModel& model = flavour.neighbours;
  const std::span<const Neighbour> neighbours = senses.neighbours();
  Vector2 sum;
  for (const Neighbour& neighbour : neighbours) {
    const double gap_m = std::max(neighbour.distance_m, model.shortest_m);
    const double distance = gap_m * model.per_metre;
    const double length = weight / (model.offset + distance);
    sum.x += length * neighbour.direction_x;
    sum.y += length * neighbour.direction_y;
  }
  if (neighbours.empty()) return steer(gain, std::nullopt, obstacle_gain, senses, flavour);
  return steer(gain, sum, obstacle_gain, senses, flavour);
}

double used_alpha(double alpha, const NeighbourModel& model) {
  return model.alpha_truncated ? std::floor(alpha) : alpha;
}

Command follow_light(double sign, Senses& senses, const Flavour& flavour) {
  const Vector2 light = light_vector(senses.light(), flavour.light);
  const double least = flavour.light.least_vector;
  const double obstacle_gain = flavour.steering.obstacle_gain;
  if (light.x * light.x + light.y * light.y < least * least) {
    return steer(1, std::nullopt, obstacle_gain, senses, flavour);
  }
  return steer(1, Vector2{sign * light.x, sign * light.y}, obstacle_gain, senses, flavour);
}

Command command_towards(double x, double y, double speed_mps, double least_inner) {
  const double length = std::sqrt(x * x + y * y);
  if (length == 0) return {0, 0};  // this includes vectors too short to square
  const double inner = speed_mps * std::max(x / length, least_inner);
  return y > 0 ? Command{inner, speed_mps} : Command{speed_mps, inner};
}

}  // namespace swarmsmith
