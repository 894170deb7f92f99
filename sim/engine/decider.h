#pragma once

#include <cstdint>
#include <optional>

#include "sim/control/reference_model.h"
#include "sim/engine/readings.h"

namespace swarmsmith {

/// What decides for the simulated robots in place of their control software: programs on the other
/// side of a wire, say.
///
/// At an instant at which robots are due for a control cycle, the engine says so (`begin`), asks
/// about each of them (`ask`), and then takes the answers in the same order (`answer`); once more
/// for those whose period is shorter than 10 ms. Readings do
/// not depend on commands of the same instant, so that a decider that answers as ControlSoftware
/// with control_stream would gets the bits of a run without a decider. The engine waits for
/// every call: a decider that has to wait for somebody blocks in `begin` or `answer`. What it
/// throws ends the run, and comes out of simulate().
class Decider {
 public:
  /// A control cycle of a robot.
  struct Question {
    int robot = 0;
    std::int64_t cycle = 0;  ///< of this robot, counts from 1
    double time_s = 0;       ///< since the start: the double that Senses::time_s gives
    /// Good until the robot's next question or the next `begin`. Each sensor is computed when first
    /// asked for; what is asked for changes nothing else. For what a controller may ask:
    /// senses_used_by.
    SimulatedSenses& senses;
  };

  struct Answer {
    Command command;  ///< finite; speeds beyond those of the wheels are cut
    int state = 0;    ///< ControlSoftware::state after the cycle; goes into the state digest
  };

  virtual ~Decider() = default;

  /// The simulated time has come to `time_s`. Comes before what is asked at it; a world that is to
  /// run in real time waits here.
  virtual void begin(double /*time_s*/) {}

  virtual void ask(const Question& question) = 0;

  /// The newest decision for a robot that was not given before. Nothing: the treads go on as they
  /// are. A decision acts from this instant on, or as much later as the profile's delays say.
  virtual std::optional<Answer> answer(int robot) = 0;

  /// Whether every step of 10 ms is an instant, with `begin`, and `answer` for every robot whether
  /// it was asked about or not: for answers that come when they come. Rounding then differs from a
  /// run without. Is asked once, before the start.
  virtual bool wants_every_step() const { return false; }
};

}  // namespace swarmsmith
