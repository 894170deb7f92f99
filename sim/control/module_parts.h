#pragma once

#include <string>

#include "base/rng.h"
#include "sim/control/flavour.h"
#include "sim/control/reference_model.h"

namespace swarmsmith {

/// The parts of modules. Each behaviour is a struct in its own file in sim/control/behaviours, each
/// condition one in sim/control/conditions; a line in sim/control/CMakeLists.txt registers it. The
/// program has no code for particular modules: texts, searches, drawings, views and assessments are
/// derived from the members below. A struct that lacks one of them does not compile:
///
/// - `kId`, its id outside the program: the struct's name in lower case, with underscores;
/// - `kLabel`, its name in drawings, on as many lines as needed to be no wider than its parameters;
/// - `parameters(module, visitor)`, which calls `visitor(ParameterSpec, member)` for each parameter
///   in the order of texts; a member is a double, an int or a ColorLabel;
/// - `operator==`.
///
/// A behaviour also has
///
/// - `uses(flavour)`, the readings that it may request, except the time;
/// - `act(senses, flavour, memory, rng)`, one control cycle. It requests only the readings it
///   needs: a robot that turns or stands still requests none.
///
/// A condition also has
///
/// - `Reads`, the reading it uses: NoReading, FloorReading, NeighbourTally, or a similar struct;
/// - `enabling(reads, flavour)`, the probability with which it enables its transition in this
///   cycle; 0 when the reading does not satisfy it. It depends only on these two arguments.

/// The kinds of readings that `Senses` gives.
struct UsedSenses {
  bool proximity = false;
  bool ground_color = false;
  bool neighbours = false;
  bool light = false;

  friend constexpr UsedSenses operator|(const UsedSenses& a, const UsedSenses& b) {
    return {.proximity = a.proximity || b.proximity,
            .ground_color = a.ground_color || b.ground_color,
            .neighbours = a.neighbours || b.neighbours,
            .light = a.light || b.light};
  }
  friend bool operator==(const UsedSenses&, const UsedSenses&) = default;
};

// The readings that conditions use. `of` requests the readings in `kUses` and no others. For the
// first three a running machine remembers the probability (machine_control.h); for any other it
// evaluates the condition in each cycle.

/// No reading: the probability is always the same.
struct NoReading {
  static constexpr UsedSenses kUses{};
  static NoReading of(Senses& /*senses*/) { return {}; }
};

/// The colour of the floor.
struct FloorReading {
  static constexpr UsedSenses kUses{.ground_color = true};
  static FloorReading of(Senses& senses) { return {senses.ground_color()}; }

  const Rgb& color;
};

/// The number of neighbours.
struct NeighbourTally {
  static constexpr UsedSenses kUses{.neighbours = true};
  static NeighbourTally of(Senses& senses) { return {senses.neighbour_count()}; }

  int count = 0;
};

/// The memory of a behaviour from one cycle to the next: the turn of Exploration, the turn and the
/// step of random walks. It is reset when a state is entered.
struct BehaviourMemory {
  /// 0: going forward. With TurnClock::Seconds, the drawn number until the turn is over.
  int turn_cycles_left = 0;
  bool turn_left = false;
  double turn_end_s = 0;      ///< for TurnClock::Seconds: the first time after the turn
  double turn_left_rad = 0;   ///< for random walks: the remaining angle of the turn; 0: going
                              ///< forward
  int step_cycles_left = -1;  ///< for random walks: the remaining cycles of the step; 0: it is
                              ///< over; -1: none has begun

  friend bool operator==(const BehaviourMemory&, const BehaviourMemory&) = default;
};

// Parameters that several modules share. The search ranges are those in the irace file of the
// published program (rvr-automode facts, section 6.4).

/// The largest count that a machine may have as a parameter.
inline constexpr double kLargestCount = 1'000'000;

/// Probability of a condition: 0..1 in the search, two decimals.
ParameterSpec beta_parameter();

/// Weight of the neighbours: 1..5 in the search, two decimals.
ParameterSpec alpha_parameter(std::string symbol, std::string token);

/// The count at which the sigmoid is one half: 0..10 in the search; the range of a flavour may
/// begin above 0.
ParameterSpec xi_parameter(std::string symbol);

/// Steepness of the sigmoid: 0..20 in the search, two decimals.
ParameterSpec eta_parameter(std::string symbol);

}  // namespace swarmsmith
