#include "sim/control/behaviours/walk.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "sim/control/behaviours/exploration.h"

namespace swarmsmith {

/// The quantile function: tan(angle / 2) = (1 - rho) / (1 + rho) tan(pi (u - 1/2)).
double wrapped_cauchy_angle(double u, double rho) {
  const double half_turn = kPi * (u - 0.5);
  return 2 * atan2((1 - rho) * sin(half_turn), (1 + rho) * cos(half_turn));
}

/// The quantile function, rounded up: the geometric distribution with mean 1 / (1 - e^(-1 / mean)).
int exponential_step(double u, double mean) {
  const double length = std::ceil(-mean * log(1 - u));
  return static_cast<int>(std::clamp(length, 1.0, double{kLongestStep}));
}

/// The quantile function for lengths from 1 on: l = (1 - u)^(-1 / (mu - 1)). For mu near 1 it may
/// be infinite, so it is limited before it becomes an integer.
int power_law_step(double u, double mu) {
  const double length = std::floor(exp(-log(1 - u) / (mu - 1)));
  return static_cast<int>(std::clamp(length, 1.0, double{kLongestStep}));
}

Command turn_on(const Flavour& flavour, BehaviourMemory& memory) {
  const double speed = flavour.speed_mps;
  const double whole_rad = 2 * speed * kControlPeriod_s / flavour.exploration.track_m;
  // The last cycle is slower, so that the turn has exactly the angle, not a multiple of the turn in
  // one cycle.
  const double part = std::min(1.0, memory.turn_left_rad / whole_rad);
  memory.turn_left_rad = part < 1 ? 0 : memory.turn_left_rad - whole_rad;
  const double tread = memory.turn_left ? -speed * part : speed * part;
  return {tread, -tread};
}

void begin_turn(double angle_rad, BehaviourMemory& memory) {
  memory.turn_left = angle_rad > 0;
  memory.turn_left_rad = std::fabs(angle_rad);
}

bool turns_away(Senses& senses, const Flavour& flavour, BehaviourMemory& memory, Rng& rng) {
  const TurnAway turn = turn_away(senses, flavour);
  if (turn == TurnAway::None) return false;
  const double angle_rad = rng.uniform(0, kPi);
  begin_turn(turn == TurnAway::Left ? angle_rad : -angle_rad, memory);
  return true;
}

}  // namespace swarmsmith
