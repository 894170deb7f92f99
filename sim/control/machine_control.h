#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/rng.h"
#include "sim/control/behaviours.h"
#include "sim/control/conditions.h"
#include "sim/control/flavour.h"
#include "sim/control/machine.h"
#include "sim/control/reference_model.h"

namespace swarmsmith {

/// A running state machine.
///
/// In each cycle (rvr-automode facts, section 6.2), a behaviour that was just entered is reset; it
/// acts; then, from the second cycle in a state on, the machine takes one of the enabled outgoing
/// transitions, if there are any, each with equal probability. The command is that of the behaviour
/// that acted.
class MachineControl {
 public:
  /// `machine` and `flavour` must outlive the object.
  MachineControl(const Machine& machine, const Flavour& flavour, Rng rng);

  Command step(Senses& senses);

  /// Index of the current state, after the last step's transition test.
  int state() const { return state_; }
  std::uint64_t drawn() const { return rng_.drawn(); }

 private:
  /// The kind of reading on which a condition's probability depends.
  enum class Reads : std::uint8_t { Nothing, Floor, Neighbours, Others };
  static constexpr int kTabledNeighbours = 8;
  static constexpr std::uint32_t kNoColor = 0xffffffff;

  /// A transition with the known values of its enabling probability. For a condition without
  /// readings this is the probability; for a condition on the floor it is the probability for the
  /// last colour seen, since robots stay on one colour for a while; for a condition on the number
  /// of neighbours these are the probabilities for the counts seen so far, and -1 for other counts.
  /// Other conditions are evaluated in each cycle.
  struct Known {
    Reads reads = Reads::Nothing;
    std::uint32_t color = kNoColor;
    double probability = 0;
    std::array<double, kTabledNeighbours> by_count;
  };

  static Known known_of(const Condition& condition, const Flavour& flavour);
  double probability_of_count(Known& known, const Condition& condition, Senses& senses) const;
  void take_transition(Senses& senses);

  const Machine* machine_;
  const Flavour* flavour_;
  Rng rng_;
  int state_ = 0;
  bool entered_ = true;
  BehaviourMemory memory_;
  std::vector<std::vector<Known>> known_;  ///< by state and transition
};

}  // namespace swarmsmith
