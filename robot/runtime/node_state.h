#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "robot/runtime/run_record.h"

namespace swarmsmith {

/// The phases of a node:
///
///     idle <-> ready -> armed -> running -> ended | stopped | failed -> (a new start) armed
enum class Phase {
  Idle,   ///< a requirement is missing: see `not_ready`
  Ready,  ///< a run can be started
  Armed,  ///< waits for the agreed start
  Running,
  Ended,    ///< the run's time is over
  Stopped,  ///< by an order or a signal
  Failed,
};
constexpr auto names_of(Phase) {
  return std::to_array<std::string_view>(
      {"idle", "ready", "armed", "running", "ended", "stopped", "failed"});
}

/// The state that a node sends twice a second and whenever it changes.
struct NodeState {
  std::string robot;
  Phase phase = Phase::Idle;
  std::string run;  ///< the present or the last run
  std::int64_t cycle = 0;
  std::string machine_digest;
  std::string flavour;
  std::string own_robot;  ///< as in an order
  std::string turn_clock;
  std::int64_t seed = 0;
  std::int64_t robot_index = 0;
  std::string version;
  std::string scheduling;
  /// Age of the last message of a needed feed; -1 before the first; none for a feed that is not
  /// needed.
  PerFeed<std::optional<double>> age_ms;
  std::int64_t held = 0;
  std::int64_t skipped = 0;
  std::optional<double> battery;  ///< charge, 0 to 1
  RunVerdict verdict = RunVerdict::Valid;
  std::vector<std::string> reasons;    ///< of the verdict
  std::vector<std::string> not_ready;  ///< reasons why a run cannot start
  std::string log_trouble;             ///< why the log cannot be written
  bool log_open = false;               ///< the run's log is not yet complete
  std::string order;                   ///< id of the last order
  std::string refused;                 ///< the reason why that order was refused; empty: obeyed
  double start_unix_s = 0;             ///< the agreed start of the run, by the wall clock
  double clock_s = 0;                  ///< CLOCK_MONOTONIC
  double unix_s = 0;                   ///< wall clock

  friend bool operator==(const NodeState&, const NodeState&) = default;
};

/// Visits the fields in the order in which they are sent, each with its key. Fields that are
/// missing in a state, or have another type, keep their defaults; so do fields that were added
/// later.
template <class AnyState, class Field>
void visit_state_fields(AnyState& state, Field& field) {
  field("robot", state.robot);
  field("state", state.phase);
  field("run", state.run);
  field("cycle", state.cycle);
  field("machine", state.machine_digest);
  field("flavour", state.flavour);
  field("own_robot", state.own_robot, !state.own_robot.empty());
  field("turn_clock", state.turn_clock);
  field("seed", state.seed);
  field("robot_index", state.robot_index);
  field("version", state.version);
  field("scheduling", state.scheduling);
  field("age_ms", state.age_ms);
  field("held", state.held);
  field("skipped", state.skipped);
  field("battery", state.battery);
  field("verdict", state.verdict);
  field("reasons", state.reasons);
  field("not_ready", state.not_ready);
  field("log_trouble", state.log_trouble);
  field("log_open", state.log_open);
  field("order", state.order);
  field("refused", state.refused);
  field("start_unix_s", state.start_unix_s);
  field("clock_s", state.clock_s);
  field("unix_s", state.unix_s);
}

/// Converts a state to JSON, and back.
std::string state_text(const NodeState& state);
Expected<NodeState> parse_state(std::string_view text);

}  // namespace swarmsmith
