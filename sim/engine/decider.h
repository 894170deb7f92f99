#pragma once

#include <cstdint>
#include <optional>

#include "sim/control/reference_model.h"
#include "sim/engine/readings.h"

namespace swarmsmith {

/// Decides for the simulated robots instead of their control software; for example, programs at the
/// other end of a connection.
///
/// At an instant when robots are due for a control cycle, the engine announces it (`begin`), asks
/// about each of these robots (`ask`), and then takes the answers in the same order (`answer`). For
/// robots with a period below 10 ms it asks again at the same instant. Readings do not depend on
/// commands of the same instant, so a decider that answers like ControlSoftware with control_stream
/// gives the same bits as a run without a decider. The engine waits for every call: a decider that
/// has to wait for others blocks in `begin` or `answer`. An exception from a decider ends the run
/// and leaves simulate().
class Decider {
 public:
  /// One control cycle of a robot.
  struct Question {
    int robot = 0;
    std::int64_t cycle = 0;  ///< of this robot, counted from 1
    double time_s = 0;       ///< since the start; the same double as Senses::time_s
    /// Valid until the robot's next question or the next `begin`. Each sensor is computed when
    /// first requested; requests have no other effect. For the readings that a controller may
    /// request: senses_used_by.
    SimulatedSenses& senses;
  };

  struct Answer {
    Command command;  ///< finite; speeds beyond the range of the wheels are clipped
    int state = 0;    ///< ControlSoftware::state after the cycle; part of the state digest
  };

  virtual ~Decider() = default;

  /// The simulated time has reached `time_s`. Called before the questions at this time; a world
  /// that runs in real time waits here.
  virtual void begin(double /*time_s*/) {}

  virtual void ask(const Question& question) = 0;

  /// The newest decision for a robot, if it was not yet returned. Nothing: the treads keep their
  /// speeds. A decision acts from this instant on, or later by the delays of the profile.
  virtual std::optional<Answer> answer(int robot) = 0;

  /// Whether `begin` is called at every step of 10 ms, and `answer` for every robot, with or
  /// without a question: for answers that arrive at any time. The rounding then differs from a run
  /// without a decider. Called once, before the start.
  virtual bool wants_every_step() const { return false; }
};

}  // namespace swarmsmith
