#include "sim/control/behaviours.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "base/overloaded.h"
#include "sim/control/flavour.h"
#include "sim/control/readings.h"

namespace swarmsmith {
namespace {

std::span<const Neighbour> neighbours_in_the_way(Senses& senses, const ObstacleModel& model) {
  return model.neighbours_as_obstacles ? senses.neighbours() : std::span<const Neighbour>{};
}

/// What Exploration knows of the front: the strongest reading, and the sums of both sides.
struct Front {
  double strongest = 0;
  Vector2 direction;
  double left = 0;
  double right = 0;

  /// Ties go to the direction nearest to straight ahead, then to the left one.
  void add(double strength, Vector2 towards, double slope) {
    if (!(std::fabs(towards.y) <= slope * towards.x)) return;
    if (towards.y > 0) left += strength;
    if (towards.y < 0) right += strength;
    const bool nearer_ahead =
        towards.x > direction.x || (towards.x == direction.x && towards.y > direction.y);
    if (strength > strongest || (strength == strongest && nearer_ahead)) {
      strongest = strength;
      direction = towards;
    }
  }

  bool turns_left() const {
    if (direction.y != 0) return direction.y < 0;
    return right > left;
  }
};

enum class Turn { None, Left, Right };

/// Away from the strongest reading of the front (thesis facts, section 6.2).
Turn turn_from_front(Senses& senses, const Flavour& flavour) {
  const ExplorationModel& model = flavour.exploration;
  Front front;
  // The others are in front by no slope.
  const FrontProximity proximity = senses.front_proximity();
  const std::span<const Neighbour> neighbours = neighbours_in_the_way(senses, flavour.obstacles);
  if (model.threshold > 0 && neighbours.empty() &&
      nothing_within(proximity, flavour.obstacles.far_m)) {
    return Turn::None;
  }
  for (std::size_t i = 0; i < proximity.size(); ++i) {
    front.add(obstacle_strength(proximity[i], flavour.obstacles), kProximityDirections[i],
              model.front_slope);
  }
  for (const Neighbour& neighbour : neighbours) {
    front.add(neighbour_strength(neighbour.distance_m, flavour.obstacles),
              {neighbour.direction_x, neighbour.direction_y}, model.front_slope);
  }
  if (front.strongest < model.threshold) return Turn::None;
  return front.turns_left() ? Turn::Left : Turn::Right;
}

/// Away from the side to which the sum of the readings points (rvr-automode facts, section 5). The
/// signs of the components stand for the angle: within +-90 degrees, and to the right.
Turn turn_from_sum(Senses& senses, const Flavour& flavour) {
  const double threshold = flavour.exploration.threshold;
  // Not shortened: that would change no sign, and leave it longer than any flavour's threshold.
  const Vector2 sum = obstacle_sum(
      senses.proximity(), neighbours_in_the_way(senses, flavour.obstacles), flavour.obstacles);
  const bool strong = sum.x * sum.x + sum.y * sum.y >= threshold * threshold;
  if (!strong || sum.x < 0) return Turn::None;
  return sum.y < 0 ? Turn::Left : Turn::Right;
}

int draw_turn_cycles(int tau, ExplorationModel::TurnLength law, Rng& rng) {
  if (law == ExplorationModel::TurnLength::ZeroToTau) {
    return static_cast<int>(rng.uniform_int(0, tau));
  }
  return std::max(1, static_cast<int>(rng.uniform_int(0, tau - 1)));
}

/// Whether this cycle still belongs to a turn that was drawn before.
bool goes_on_turning(BehaviourMemory& memory, Senses& senses, TurnClock clock) {
  if (memory.turn_cycles_left == 0) return false;
  if (clock == TurnClock::Cycles) {
    --memory.turn_cycles_left;
    return true;
  }
  if (senses.time_s() < memory.turn_end_s) return true;
  memory.turn_cycles_left = 0;
  return false;
}

Command explore(const Exploration& exploration, Senses& senses, const Flavour& flavour,
                BehaviourMemory& memory, Rng& rng) {
  const double speed = flavour.speed_mps;
  if (goes_on_turning(memory, senses, flavour.exploration.turn_clock)) {
    return memory.turn_left ? Command{-speed, speed} : Command{speed, -speed};
  }
  const Turn turn = flavour.exploration.trigger == ExplorationModel::Trigger::FrontReadings
                        ? turn_from_front(senses, flavour)
                        : turn_from_sum(senses, flavour);
  if (turn != Turn::None) {
    memory.turn_left = turn == Turn::Left;
    memory.turn_cycles_left =
        draw_turn_cycles(exploration.tau, flavour.exploration.turn_length, rng);
    if (flavour.exploration.turn_clock == TurnClock::Seconds) {
      // Commands change only at cycles. The half makes T = r * 0.1 s end between two nominal ones,
      // whatever the clock rounds; with another period the turn is right to a cycle.
      memory.turn_end_s = senses.time_s() + (memory.turn_cycles_left + 0.5) * kControlPeriod_s;
    }
  }
  return {speed, speed};
}

/// Along gain * w' - obstacle_gain * w_o (thesis eq. 5.1 to 5.6), where w' is `target`, or what the
/// flavour takes for it when there is nothing to go by.
Command steer(double gain, const std::optional<Vector2>& target, Senses& senses,
              const Flavour& flavour) {
  const SteeringModel& model = flavour.steering;
  const Vector2 otherwise{model.forward_by_default ? 1.0 : 0.0, 0};
  const Vector2 wanted = target.value_or(otherwise);
  const Vector2 obstacles = obstacle_vector(
      senses.proximity(), neighbours_in_the_way(senses, flavour.obstacles), flavour.obstacles);
  Vector2 result{gain * wanted.x - model.obstacle_gain * obstacles.x,
                 gain * wanted.y - model.obstacle_gain * obstacles.y};
  const double square = result.x * result.x + result.y * result.y;
  if (square < model.shortest_result * model.shortest_result) result = {1, 0};
  return command_towards(result.x, result.y, flavour.speed_mps);
}

/// Towards the neighbours, away from them for a negative `weight`.
Command follow_neighbours(double gain, double weight, Senses& senses, const Flavour& flavour) {
  const NeighbourModel& model = flavour.neighbours;
  const std::span<const Neighbour> neighbours = senses.neighbours();
  Vector2 sum;
  for (const Neighbour& neighbour : neighbours) {
    const double distance = std::max(neighbour.distance_m, model.shortest_m) * model.per_metre;
    const double length = weight / (model.offset + distance);
    sum.x += length * neighbour.direction_x;
    sum.y += length * neighbour.direction_y;
  }
  if (neighbours.empty()) return steer(gain, std::nullopt, senses, flavour);
  return steer(gain, sum, senses, flavour);
}

/// Towards the light for sign 1, away from it for -1 (thesis eq. 5.1, 5.2).
Command follow_light(double sign, Senses& senses, const Flavour& flavour) {
  const Vector2 light = light_vector(senses.light(), flavour.light);
  const double least = flavour.light.least_vector;
  if (light.x * light.x + light.y * light.y < least * least) {
    return steer(1, std::nullopt, senses, flavour);
  }
  return steer(1, Vector2{sign * light.x, sign * light.y}, senses, flavour);
}

double used_alpha(double alpha, const NeighbourModel& model) {
  return model.alpha_truncated ? std::floor(alpha) : alpha;
}

void need_parameters(std::span<const double> parameters, std::size_t count) {
  if (parameters.size() == count) return;
  throw std::invalid_argument("a behaviour takes " + std::to_string(count) + " parameters, not " +
                              std::to_string(parameters.size()));
}

std::size_t parameter_count(Module module) {
  const bool none =
      module == Module::Stop || module == Module::Phototaxis || module == Module::AntiPhototaxis;
  return none ? 0 : 1;
}

}  // namespace

Module module_of(const Behaviour& behaviour) {
  return std::visit(Overloaded{[](const Exploration&) { return Module::Exploration; },
                               [](const Stop&) { return Module::Stop; },
                               [](const Phototaxis&) { return Module::Phototaxis; },
                               [](const AntiPhototaxis&) { return Module::AntiPhototaxis; },
                               [](const Attraction&) { return Module::Attraction; },
                               [](const Repulsion&) { return Module::Repulsion; }},
                    behaviour);
}

std::vector<double> parameters_of(const Behaviour& behaviour) {
  using Values = std::vector<double>;
  return std::visit(
      Overloaded{[](const Exploration& b) { return Values{static_cast<double>(b.tau)}; },
                 [](const Stop&) { return Values{}; }, [](const Phototaxis&) { return Values{}; },
                 [](const AntiPhototaxis&) { return Values{}; },
                 [](const Attraction& b) { return Values{b.alpha}; },
                 [](const Repulsion& b) { return Values{b.alpha}; }},
      behaviour);
}

Behaviour make_behaviour(Module module, std::span<const double> parameters) {
  need_parameters(parameters, parameter_count(module));
  switch (module) {
    case Module::Exploration:
      return Exploration{static_cast<int>(parameters[0])};
    case Module::Stop:
      return Stop{};
    case Module::Phototaxis:
      return Phototaxis{};
    case Module::AntiPhototaxis:
      return AntiPhototaxis{};
    case Module::Attraction:
      return Attraction{parameters[0]};
    case Module::Repulsion:
      return Repulsion{parameters[0]};
    case Module::BlackFloor:
    case Module::GrayFloor:
    case Module::WhiteFloor:
    case Module::NeighbourCount:
    case Module::InvertedNeighbourCount:
    case Module::FixedProbability:
    case Module::ColorDetection:
      break;
  }
  throw std::invalid_argument(std::string(id_of(module)) + " is not a behaviour");
}

Command act(const Behaviour& behaviour, Senses& senses, const Flavour& flavour,
            BehaviourMemory& memory, Rng& rng) {
  const NeighbourModel& model = flavour.neighbours;
  return std::visit(
      Overloaded{[&](const Exploration& b) { return explore(b, senses, flavour, memory, rng); },
                 [](const Stop&) {
                   return Command{0, 0};
                 },
                 [&](const Phototaxis&) { return follow_light(1, senses, flavour); },
                 [&](const AntiPhototaxis&) { return follow_light(-1, senses, flavour); },
                 [&](const Attraction& b) {
                   return follow_neighbours(model.attraction_gain, used_alpha(b.alpha, model),
                                            senses, flavour);
                 },
                 [&](const Repulsion& b) {
                   const double alpha = used_alpha(b.alpha, model);
                   const double weight = model.repulsion_power == 2 ? alpha * alpha : alpha;
                   return follow_neighbours(model.repulsion_gain, -weight, senses, flavour);
                 }},
      behaviour);
}

Command command_towards(double x, double y, double speed_mps) {
  const double length = std::sqrt(x * x + y * y);
  if (length == 0) return {0, 0};  // also a vector that is too short to square
  const double inner = speed_mps * (x / length);
  return y > 0 ? Command{inner, speed_mps} : Command{speed_mps, inner};
}

}  // namespace swarmsmith
