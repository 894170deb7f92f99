#pragma once

#include "sim/control/behaviours/steering.h"

namespace swarmsmith {

/// Random walks: straight steps with turns on the spot between them, and a turn away from what
/// stands in front (Dimidov et al., ANTS 2016; as modules: Spaey et al., BNAIC 2020, Coconut).

/// The longest step in control cycles: 100 s.
inline constexpr int kLongestStep = 1000;

/// An angle in [-pi, pi] of the wrapped Cauchy law around 0 with concentration `rho`: uniform for
/// 0, always 0 for 1. `u` is uniform in [0, 1).
double wrapped_cauchy_angle(double u, double rho);

/// Length of a step in control cycles, at least 1: exponential with this mean, or of the power law
/// P(l) ~ l^-mu, cut at kLongestStep. `u` is uniform in [0, 1).
int exponential_step(double u, double mean);
int power_law_step(double u, double mu);

/// One control cycle. `rho`: of the turns between steps; `draw_step(u)`: the length of the next
/// step.
template <class DrawStep>
Command walk(double rho, const DrawStep& draw_step, Senses& senses, const Flavour& flavour,
             BehaviourMemory& memory, Rng& rng);

/// A cycle of the turn that is under way, for as much of the angle as is left.
Command turn_on(const Flavour& flavour, BehaviourMemory& memory);

/// Begins a turn by this angle, to the left where it is positive.
void begin_turn(double angle_rad, BehaviourMemory& memory);

/// Whether something stands in front, as the flavour's Exploration sees it; then a turn away from
/// it begins, by an angle of 0 to pi.
bool turns_away(Senses& senses, const Flavour& flavour, BehaviourMemory& memory, Rng& rng);

template <class DrawStep>
Command walk(double rho, const DrawStep& draw_step, Senses& senses, const Flavour& flavour,
             BehaviourMemory& memory, Rng& rng) {
  if (memory.turn_left_rad > 0) return turn_on(flavour, memory);
  const Command ahead{flavour.speed_mps, flavour.speed_mps};
  if (turns_away(senses, flavour, memory, rng)) {
    memory.step_cycles_left = draw_step(rng.uniform());
    return ahead;
  }
  // A state that is entered begins with a step.
  if (memory.step_cycles_left == 0) begin_turn(wrapped_cauchy_angle(rng.uniform(), rho), memory);
  if (memory.step_cycles_left <= 0) memory.step_cycles_left = draw_step(rng.uniform());
  if (memory.turn_left_rad > 0) return turn_on(flavour, memory);
  --memory.step_cycles_left;
  return ahead;
}

}  // namespace swarmsmith
