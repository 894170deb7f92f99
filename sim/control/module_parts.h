#pragma once

#include <string>

#include "base/rng.h"
#include "sim/control/flavour.h"
#include "sim/control/reference_model.h"

namespace swarmsmith {

/// What modules are made of. Each behaviour is a struct in a file of its own in
/// sim/control/behaviours, each condition one in sim/control/conditions; its line in
/// sim/control/CMakeLists.txt makes it known. The program knows no module by name: texts, searches,
/// drawings, views and assessments follow from what each struct must have, and it does not compile
/// without:
///
/// - `kId`, its id outside of the program: the struct's name in lower case, with underscores;
/// - `kLabel`, its name in drawings, on as many lines as it takes to be no wider than its
///   parameters;
/// - `parameters(module, visitor)`, which calls `visitor(ParameterSpec, member)` for each parameter
///   in the order of texts; a member is a double, an int or a ColorLabel;
/// - `operator==`.
///
/// A behaviour has besides
///
/// - `uses(flavour)`, the readings that it may ask for, without the time;
/// - `act(senses, flavour, memory, rng)`, one control cycle. It asks only for what it needs: a
///   turning or a standing robot asks for nothing.
///
/// A condition has besides
///
/// - `Reads`, what it reads: NoReading, FloorReading, NeighbourTally, or a struct like them;
/// - `enabling(reads, flavour)`, the probability with which it enables its transition in this
///   cycle; 0 when the reading is not the one it waits for. It follows from these two alone.

/// Kinds of readings of `Senses`.
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

// What conditions read. Its `of` asks for what `kUses` says and for nothing else. Of the first
// three a running machine remembers the probability (machine_control.h); of any other it asks anew
// in each cycle.

/// Nothing: the probability is always the same.
struct NoReading {
  static constexpr UsedSenses kUses{};
  static NoReading of(Senses& /*senses*/) { return {}; }
};

/// The floor's colour.
struct FloorReading {
  static constexpr UsedSenses kUses{.ground_color = true};
  static FloorReading of(Senses& senses) { return {senses.ground_color()}; }

  const Rgb& color;
};

/// How many neighbours there are.
struct NeighbourTally {
  static constexpr UsedSenses kUses{.neighbours = true};
  static NeighbourTally of(Senses& senses) { return {senses.neighbour_count()}; }

  int count = 0;
};

/// What a behaviour remembers from one cycle to the next: the turn of Exploration, the turn and the
/// step of random walks. A state that is
/// entered begins with a fresh one.
struct BehaviourMemory {
  /// 0: going forward. By TurnClock::Seconds, the drawn number until the turn is over.
  int turn_cycles_left = 0;
  bool turn_left = false;
  double turn_end_s = 0;      ///< of TurnClock::Seconds: the first time after the turn
  double turn_left_rad = 0;   ///< of random walks: the rest of the turn; 0: going forward
  int step_cycles_left = -1;  ///< the same of the step; 0: it is over; -1: none was begun

  friend bool operator==(const BehaviourMemory&, const BehaviourMemory&) = default;
};

// Parameters that several modules have. The search ranges are those of the published program's
// irace file (rvr-automode facts, section 6.4).

/// Counts that a machine may hold.
inline constexpr double kLargestCount = 1'000'000;

/// Probability of a condition: 0..1 in the search, two decimals.
ParameterSpec beta_parameter();

/// Weight of the neighbours: 1..5 in the search, two decimals.
ParameterSpec alpha_parameter(std::string symbol, std::string token);

/// The count at which the sigmoid is one half: 0..10 in the search; a flavour may begin higher.
ParameterSpec xi_parameter(std::string symbol);

/// Steepness of the sigmoid: 0..20 in the search, two decimals.
ParameterSpec eta_parameter(std::string symbol);

}  // namespace swarmsmith
