#include "sim/control/behaviours/exploration.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "sim/control/readings.h"

namespace swarmsmith {
namespace {

/// The readings of the front, summarised: the strongest one, and the sums of both sides.
struct Front {
  double strongest = 0;
  Vector2 direction;
  double left = 0;
  double right = 0;

  /// In a tie, the direction nearest to straight ahead wins, then the left one.
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

using Turn = TurnAway;

/// Turns away from the strongest reading of the front (thesis facts, section 6.2). `directions`
/// holds the directions of the sensors, by index.
template <std::size_t N>
Turn turn_from(std::span<const double, N> proximity, std::span<const Vector2> directions,
               Senses& senses, const Flavour& flavour) {
  const ExplorationModel& model = flavour.exploration;
  Front front;
  const std::span<const Neighbour> neighbours = neighbours_in_the_way(senses, flavour.obstacles);
  const bool are_distances = flavour.obstacles.reading != ObstacleModel::Reading::AsSensed;
  if (are_distances && model.threshold > 0 && neighbours.empty() &&
      nothing_within(proximity, flavour.obstacles.far_m)) {
    return Turn::None;
  }
  for (std::size_t i = 0; i < proximity.size(); ++i) {
    front.add(obstacle_strength(proximity[i], flavour.obstacles), directions[i], model.front_slope);
  }
  for (const Neighbour& neighbour : neighbours) {
    front.add(neighbour_strength(neighbour.distance_m, flavour.obstacles),
              {neighbour.direction_x, neighbour.direction_y}, model.front_slope);
  }
  if (front.strongest < model.threshold) return Turn::None;
  return front.turns_left() ? Turn::Left : Turn::Right;
}

Turn turn_from_front(Senses& senses, const Flavour& flavour) {
  if (const auto& directions = flavour.obstacles.directions) {
    const ProximityReadings proximity = senses.proximity();
    if (proximity.size() > kProximitySensors)
      return turn_from(proximity, *directions, senses, flavour);
    return turn_from(proximity.first<kProximitySensors>(), *directions, senses, flavour);  // faster
  }
  // The other sensors are not in front for any slope.
  return turn_from(senses.front_proximity(), kProximityDirections, senses, flavour);
}

/// Turns away from the side to which the sum of the readings points (rvr-automode facts, section
/// 5). The signs of the components replace the angle: whether it is within +-90 degrees, and to the
/// right.
Turn turn_from_sum(Senses& senses, const Flavour& flavour) {
  const double threshold = flavour.exploration.threshold;
  // The sum is not shortened: that would change no sign, and it would stay longer than any
  // flavour's threshold.
  const Vector2 sum = obstacle_sum(
      senses.proximity(), neighbours_in_the_way(senses, flavour.obstacles), flavour.obstacles);
  const bool strong = sum.x * sum.x + sum.y * sum.y >= threshold * threshold;
  if (!strong || sum.x < 0) return Turn::None;
  return sum.y < 0 ? Turn::Left : Turn::Right;
}

/// The front sensors decide whether to turn, the sum of all readings decides in which direction
/// (epuck facts, 5.2.1).
Turn turn_from_front_by_sum(Senses& senses, const Flavour& flavour) {
  if (turn_from_front(senses, flavour) == Turn::None) return Turn::None;
  const Vector2 sum = obstacle_sum(
      senses.proximity(), neighbours_in_the_way(senses, flavour.obstacles), flavour.obstacles);
  return sum.y < 0 ? Turn::Left : Turn::Right;
}

int draw_turn_cycles(int tau, ExplorationModel::TurnLength law, Rng& rng) {
  if (law == ExplorationModel::TurnLength::ZeroToTau) {
    return static_cast<int>(rng.uniform_int(0, tau));
  }
  return std::max(1, static_cast<int>(rng.uniform_int(0, tau - 1)));
}

/// Whether this cycle still belongs to the current turn.
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

}  // namespace

TurnAway turn_away(Senses& senses, const Flavour& flavour) {
  switch (flavour.exploration.trigger) {
    case ExplorationModel::Trigger::FrontReadings:
      return turn_from_front(senses, flavour);
    case ExplorationModel::Trigger::VectorSum:
      return turn_from_sum(senses, flavour);
    case ExplorationModel::Trigger::FrontThenSum:
      break;
  }
  return turn_from_front_by_sum(senses, flavour);
}

/// Flattened because robots explore most of the time, and calls would cost a noticeable part of the
/// function's time.
[[gnu::flatten]] Command Exploration::act(Senses& senses, const Flavour& flavour,
                                          BehaviourMemory& memory, Rng& rng) const {
  const double speed = flavour.speed_mps;
  if (goes_on_turning(memory, senses, flavour.exploration.turn_clock)) {
    return memory.turn_left ? Command{-speed, speed} : Command{speed, -speed};
  }
  const Turn turn = turn_away(senses, flavour);
  if (turn != Turn::None) {
    memory.turn_left = turn == Turn::Left;
    memory.turn_cycles_left = draw_turn_cycles(tau, flavour.exploration.turn_length, rng);
    if (flavour.exploration.turn_clock == TurnClock::Seconds) {
      // Commands change only at cycles. The half cycle puts the end of T = r * 0.1 s between two
      // nominal cycles, however the clock rounds; with another period the turn is right to within a
      // cycle.
      memory.turn_end_s = senses.time_s() + (memory.turn_cycles_left + 0.5) * kControlPeriod_s;
    }
  }
  return {speed, speed};
}

}  // namespace swarmsmith
