#pragma once

#include <array>
#include <cstddef>

#include "base/rng.h"
#include "sim/control/behaviours.h"
#include "sim/control/flavour.h"
#include "sim/control/machine.h"
#include "sim/control/reference_model.h"

namespace swarmsmith {

/// A running state machine.
///
/// A cycle (rvr-automode facts, section 6.2): a behaviour that was just entered is reset; it acts;
/// then, from the second cycle in a state on, one of the enabled outgoing transitions, if any, is
/// taken, each of the enabled ones with equal probability. The command is the one of the behaviour
/// that acted.
class MachineControl {
 public:
  /// `machine` and `flavour` must outlive the object.
  MachineControl(const Machine& machine, const Flavour& flavour, Rng rng);

  Command step(Senses& senses);

  /// Index of the current state, after the last step's transition test.
  int state() const { return state_; }

 private:
  /// Enabling probabilities of the neighbour counts, filled in as counts turn up; -1 is unknown.
  static constexpr int kTabledNeighbours = 8;
  using SigmoidTable = std::array<double, kTabledNeighbours>;

  double probability_of(const Condition& condition, std::size_t transition, Senses& senses);
  void take_transition(Senses& senses);

  const Machine* machine_;
  const Flavour* flavour_;
  Rng rng_;
  int state_ = 0;
  bool entered_ = true;
  BehaviourMemory memory_;
  std::array<std::array<SigmoidTable, kMaxTransitions>, kMaxStates> sigmoids_;
};

}  // namespace swarmsmith
