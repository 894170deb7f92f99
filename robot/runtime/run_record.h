#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "robot/runtime/sensed.h"
#include "sim/control/reference_model.h"

namespace swarmsmith {

/// The record of one run by a robot's node. It allows the run to be stepped again and compared with
/// a camera's measurements (docs/robot-runtime.md, "The log").

/// The action of a node in a cycle.
enum class Act {
  Step,  ///< the controller decided
  Hold,  ///< a needed sensor or the operator was silent, or the driver did not obey: the treads
         ///< stood still, and the controller was not stepped
};
constexpr auto names_of(Act) {
  return std::to_array<std::string_view>({"step", "hold"});
}

/// A colour as the driver sent it, in its own scale.
struct RawColor {
  double r = 0;
  double g = 0;
  double b = 0;

  friend bool operator==(const RawColor&, const RawColor&) = default;
};

/// One control cycle.
struct LogRow {
  std::int64_t cycle = 0;  ///< from 1; missing numbers are skipped cycles
  double clock_s = 0;      ///< CLOCK_MONOTONIC of the robot when the cycle began
  double late_ms = 0;      ///< delay after its deadline
  Act act = Act::Step;
  int state = 0;    ///< of the controller, after the cycle
  Command command;  ///< as sent
  Sensed sensed;    ///< input of the controller
  RawColor ground_as_sent;
  PerFeed<std::optional<double>>
      age_ms;  ///< time since the feed's last message; none if there was no message
  /// Time from the stamp of that message to its arrival, by two clocks; none without a stamp.
  PerFeed<std::optional<double>> stamp_ms;
  std::uint64_t drawn = 0;  ///< number of random numbers drawn so far
  std::string event;        ///< remark for the user; mostly empty
};

/// How far a run can be trusted.
enum class RunVerdict { Valid, Degraded, Invalid };
/// The same names as for filmed runs.
constexpr auto names_of(RunVerdict) {
  return std::to_array<std::string_view>({"VALID", "DEGRADED", "INVALID"});
}

/// The results that are determined at the end of a run.
struct RunEnd {
  std::string state;  ///< `ended`, `stopped` or `failed`
  RunVerdict verdict = RunVerdict::Valid;
  std::vector<std::string> reasons;
  std::int64_t stepped = 0;
  std::int64_t held = 0;
  std::int64_t skipped = 0;
  /// Whether a driver reported the tread speeds; none: an older log, or a run in lock-step.
  std::optional<bool> driven;
  /// If a driver reported: the node's verdict on it, and the longest time during which the treads
  /// were not known to obey, or another sender acted on them.
  RunVerdict driver = RunVerdict::Valid;
  double driver_off_s = 0;

  friend bool operator==(const RunEnd&, const RunEnd&) = default;
};

/// The data that apply to the whole run.
struct LogHead {
  std::string run;               ///< "run07"
  std::string robot;             ///< "rvr1"
  std::int64_t robot_index = 0;  ///< of the random stream, from 0
  std::string machine;           ///< text of the grammar
  std::string machine_digest;
  std::string flavour;
  std::string own_flavour;  ///< the complete flavour as the text of a file; empty for a built-in
                            ///< one
  std::string own_robot;    ///< the robot as in an order; empty for an RVR
  std::string turn_clock;
  std::int64_t seed = 1;
  bool lock_step = false;  ///< stepped by a simulated world instead of the clock
  double period_s = kControlPeriod_s;
  double seconds = 0;  ///< planned duration of the run; 0: the world decides
  double max_mps = 0;
  std::string program;  ///< with its version
  std::string host;
  std::string scheduling;  ///< of the control thread
  /// The topics of the feeds: (name, topic after remapping).
  std::vector<std::pair<std::string, std::string>> topics;
  double start_clock_s = 0;  ///< CLOCK_MONOTONIC of the robot
  double start_unix_s = 0;   ///< its wall clock at the same instant
  /// The robot's wall clock minus the operator's, as measured by `start`.
  std::optional<double> clock_offset_s;
  std::optional<RunEnd> end;  ///< none: the node was killed

  friend bool operator==(const LogHead&, const LogHead&) = default;
};

/// A whole log.
struct RunRecord {
  LogHead head;
  std::vector<LogRow> rows;
};

}  // namespace swarmsmith
