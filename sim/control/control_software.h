#pragma once

#include <cstdint>
#include <variant>

#include "base/rng.h"
#include "sim/control/controller.h"
#include "sim/control/flavour.h"
#include "sim/control/machine_control.h"
#include "sim/control/reference_model.h"

namespace swarmsmith {

/// The random numbers of a robot's control software in a run, the robot counted from 0: a
/// ControlSoftware started with them, in the simulator or on a robot, has the same draws.
Rng control_stream(std::int64_t seed, int robot);

/// One robot's running controller. Senses in, command out; links nothing of a simulator.
class ControlSoftware {
 public:
  /// `controller` and `flavour` must outlive the object.
  ControlSoftware(const Controller& controller, const Flavour& flavour, Rng rng);

  Command step(Senses& senses) {
    return std::visit([&senses](auto& running) { return running.step(senses); }, running_);
  }

  /// Index of the current state of a machine or subtree of a tree, after the last step; 0 of a
  /// network.
  int state() const {
    return std::visit([](const auto& running) { return running.state(); }, running_);
  }

  /// How many random numbers were drawn so far.
  std::uint64_t drawn() const {
    return std::visit([](const auto& running) { return running.drawn(); }, running_);
  }

 private:
  std::variant<MachineControl, TreeControl, NetworkControl> running_;
};

}  // namespace swarmsmith
