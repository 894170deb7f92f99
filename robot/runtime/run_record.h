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

/// What a robot's node wrote down of one run, so that it can be stepped again and compared with
/// what a camera saw (docs/robot-runtime.md, "The log").

/// What a node did in a cycle.
enum class Act {
  Step,  ///< the controller decided
  Hold,  ///< a needed sensor was silent: treads 0, the controller did not see the cycle
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
  std::int64_t cycle = 0;  ///< from 1; a number that is missing was skipped
  double clock_s = 0;      ///< CLOCK_MONOTONIC of the robot when the cycle began
  double late_ms = 0;      ///< behind its deadline
  Act act = Act::Step;
  int state = 0;    ///< of the controller, after the cycle
  Command command;  ///< as sent
  Sensed sensed;    ///< what the controller saw
  RawColor ground_as_sent;
  PerFeed<std::optional<double>>
      age_ms;  ///< since the feed's last message; none of one never heard
  /// From the time stamp of that message to its arrival, by two clocks; none without a stamp.
  PerFeed<std::optional<double>> stamp_ms;
  std::uint64_t drawn = 0;  ///< random numbers, in all
  std::string event;        ///< what a person should know; mostly empty
};

/// How trustworthy a run is.
enum class RunVerdict { Valid, Degraded, Invalid };
/// As for filmed runs.
constexpr auto names_of(RunVerdict) {
  return std::to_array<std::string_view>({"VALID", "DEGRADED", "INVALID"});
}

/// What is decided when a run is over.
struct RunEnd {
  std::string state;  ///< `ended`, `stopped` or `failed`
  RunVerdict verdict = RunVerdict::Valid;
  std::vector<std::string> reasons;
  std::int64_t stepped = 0;
  std::int64_t held = 0;
  std::int64_t skipped = 0;
  /// Whether a driver said what it has the treads do; none: an older log, or one of a lock-step.
  std::optional<bool> driven;
  /// If one did: what the node thinks of it, and the longest time for which the treads were not
  /// known to do as commanded, or another one acted on them.
  RunVerdict driver = RunVerdict::Valid;
  double driver_off_s = 0;

  friend bool operator==(const RunEnd&, const RunEnd&) = default;
};

/// What holds for the whole run.
struct LogHead {
  std::string run;               ///< "run07"
  std::string robot;             ///< "rvr1"
  std::int64_t robot_index = 0;  ///< of the random stream, from 0
  std::string machine;           ///< text of the grammar
  std::string machine_digest;
  std::string flavour;
  std::string own_flavour;  ///< all of it as a file; empty for one that is built in
  std::string turn_clock;
  std::int64_t seed = 1;
  bool lock_step = false;  ///< stepped by a simulated world, not by the clock
  double period_s = kControlPeriod_s;
  double seconds = 0;  ///< that the run was to last; 0: as the world likes
  double max_mps = 0;
  std::string program;  ///< with its version
  std::string host;
  std::string scheduling;  ///< of the control thread
  /// Where feeds came from: (name, topic as remapped).
  std::vector<std::pair<std::string, std::string>> topics;
  double start_clock_s = 0;  ///< CLOCK_MONOTONIC of the robot
  double start_unix_s = 0;   ///< its wall clock at the same instant
  /// Wall clock of the robot minus that of the operator, as `start` measured it.
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
