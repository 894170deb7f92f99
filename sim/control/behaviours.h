#pragma once

#include <span>
#include <variant>
#include <vector>

#include "base/rng.h"
#include "sim/control/module.h"
#include "sim/control/reference_model.h"

namespace swarmsmith {

struct Flavour;

/// Low-level behaviours, one a state of the machine. What they do in detail is the flavour's data;
/// the sources are thesis facts, section 6, and rvr-automode facts, section 5.

/// Straight on until there is an obstacle in front, then a turn on the spot for a random number of
/// control cycles.
struct Exploration {
  int tau = 1;  ///< bound of the drawn number of turning cycles; 1..100 in the search

  friend bool operator==(const Exploration&, const Exploration&) = default;
};

/// Stands still.
struct Stop {
  friend bool operator==(const Stop&, const Stop&) = default;
};

/// Towards the light, away from obstacles (thesis eq. 5.1).
struct Phototaxis {
  friend bool operator==(const Phototaxis&, const Phototaxis&) = default;
};

/// Away from the light and from obstacles (thesis eq. 5.2).
struct AntiPhototaxis {
  friend bool operator==(const AntiPhototaxis&, const AntiPhototaxis&) = default;
};

/// Towards the neighbours, away from obstacles (thesis eq. 5.3, 5.5).
struct Attraction {
  double alpha = 1;  ///< weight of the neighbours; 1..5 in the search

  friend bool operator==(const Attraction&, const Attraction&) = default;
};

/// Away from the neighbours and from obstacles (thesis eq. 5.4, 5.6).
struct Repulsion {
  double alpha = 1;  ///< weight of the neighbours; 1..5 in the search

  friend bool operator==(const Repulsion&, const Repulsion&) = default;
};

using Behaviour =
    std::variant<Exploration, Stop, Phototaxis, AntiPhototaxis, Attraction, Repulsion>;

Module module_of(const Behaviour& behaviour);

/// The parameters' values, in the order of the flavour's table.
std::vector<double> parameters_of(const Behaviour& behaviour);

/// The inverse of the two above. Throws std::invalid_argument when `module` is no behaviour or the
/// number of parameters is another.
Behaviour make_behaviour(Module module, std::span<const double> parameters);

/// What a behaviour remembers from one cycle to the next: Exploration's turn. A state that is
/// entered begins with a fresh one.
struct BehaviourMemory {
  /// 0: going forward. By TurnClock::Seconds, the drawn number until the turn is over.
  int turn_cycles_left = 0;
  bool turn_left = false;
  double turn_end_s = 0;  ///< of TurnClock::Seconds: the first time that is no turn any more

  friend bool operator==(const BehaviourMemory&, const BehaviourMemory&) = default;
};

/// One control cycle of a behaviour. Asks `senses` only for what it needs: a turning or a standing
/// robot asks for nothing.
Command act(const Behaviour& behaviour, Senses& senses, const Flavour& flavour,
            BehaviourMemory& memory, Rng& rng);

/// Treads that steer towards the vector (x, y) of the robot's frame at speed `speed_mps`: the tread
/// on the far side at full speed, the other at the cosine of the angle; only the direction counts,
/// and the zero vector stands still (rvr-automode facts, section 4.3).
Command command_towards(double x, double y, double speed_mps);

}  // namespace swarmsmith
