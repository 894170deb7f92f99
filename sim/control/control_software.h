#pragma once

#include <cstdint>
#include <variant>

#include "base/rng.h"
#include "sim/control/controller.h"
#include "sim/control/flavour.h"
#include "sim/control/machine_control.h"
#include "sim/control/reference_model.h"

namespace swarmsmith {

/// The random stream of a robot's control software in a run; robots are counted from 0. A
/// ControlSoftware that starts with this stream draws the same numbers in the simulator and on a
/// robot.
Rng control_stream(std::int64_t seed, int robot);

/// The running controller of one robot. It takes readings and gives commands; it links no code of a
/// simulator.
class ControlSoftware {
 public:
  /// `controller` and `flavour` must outlive the object.
  ControlSoftware(const Controller& controller, const Flavour& flavour, Rng rng);

  Command step(Senses& senses) {
    return std::visit([&senses](auto& running) { return running.step(senses); }, running_);
  }

  /// Index of the current state of a machine, or of the current subtree of a tree, after the last
  /// step; 0 for a network.
  int state() const {
    return std::visit([](const auto& running) { return running.state(); }, running_);
  }

  /// The number of random numbers drawn so far.
  std::uint64_t drawn() const {
    return std::visit([](const auto& running) { return running.drawn(); }, running_);
  }

 private:
  std::variant<MachineControl, TreeControl, NetworkControl> running_;
};

}  // namespace swarmsmith
