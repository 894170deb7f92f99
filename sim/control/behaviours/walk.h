#pragma once

#include "sim/control/behaviours/steering.h"

namespace swarmsmith {

/// Random walks: straight steps with turns on the spot between them, and a turn away from obstacles
/// in front (Dimidov et al., ANTS 2016; as modules: Spaey et al., BNAIC 2020, Coconut).

/// The longest step in control cycles: 100 s.
inline constexpr int kLongestStep = 1000;

/// An angle in [-pi, pi] drawn from the wrapped Cauchy distribution around 0 with concentration
/// `rho`: uniform for 0, always 0 for 1. `u` is uniform in [0, 1).
double wrapped_cauchy_angle(double u, double rho);

/// Length of a step in control cycles, at least 1: exponentially distributed with this mean, or
/// following the power law P(l) ~ l^-mu; both are cut at kLongestStep. `u` is uniform in [0, 1).
int exponential_step(double u, double mean);
int power_law_step(double u, double mu);

/// Runs one control cycle. `rho` is the concentration of the turns between steps; `draw_step(u)`
/// gives the length of the next step.
template <class DrawStep>
Command walk(double rho, const DrawStep& draw_step, Senses& senses, const Flavour& flavour,
             BehaviourMemory& memory, Rng& rng);

/// Runs one cycle of the current turn, by at most the remaining angle.
Command turn_on(const Flavour& flavour, BehaviourMemory& memory);

/// Begins a turn by this angle, to the left if it is positive.
void begin_turn(double angle_rad, BehaviourMemory& memory);

/// Whether there is an obstacle in front by the rule of the flavour's Exploration. If so, begins a
/// turn away from it by an angle of 0 to pi.
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
  // A newly entered state begins with a step.
  if (memory.step_cycles_left == 0) begin_turn(wrapped_cauchy_angle(rng.uniform(), rho), memory);
  if (memory.step_cycles_left <= 0) memory.step_cycles_left = draw_step(rng.uniform());
  if (memory.turn_left_rad > 0) return turn_on(flavour, memory);
  --memory.step_cycles_left;
  return ahead;
}

}  // namespace swarmsmith
