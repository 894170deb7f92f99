#include "robot/runtime/replay.h"

#include <fmt/format.h>

#include <bit>
#include <utility>

#include "base/assert.h"
#include "base/plain_text.h"
#include "robot/runtime/node.h"
#include "sim/control/control_software.h"
#include "sim/control/flavour_file.h"
#include "sim/engine/fitting.h"
#include "sim/files/robot_file.h"

namespace swarmsmith {
namespace {

/// Not ==: -0 and 0 differ here, and two equal NaNs do not.
bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// The difference between the row and the controller's decision; empty when there is none.
std::string difference(const LogRow& row, const Command& command, int state, std::uint64_t drawn) {
  if (!same_bits(row.command.left_mps, command.left_mps) ||
      !same_bits(row.command.right_mps, command.right_mps)) {
    return fmt::format("the log has the speeds {} and {} m/s, the controller gives {} and {} m/s",
                       row.command.left_mps, row.command.right_mps, command.left_mps,
                       command.right_mps);
  }
  if (row.command.leds != command.leds) return "other LEDs than the controller's";
  // Commands alone may agree by chance. State and number of random numbers show a difference in the
  // cycle in which it begins.
  if (row.state != state)
    return fmt::format("the log has state {}, the controller is in {}", row.state, state);
  if (row.drawn != drawn)
    return fmt::format("the log has {}, the controller drew {}",
                       counted(row.drawn, "random number"), drawn);
  return {};
}

Expected<TurnClock> turn_clock_of(const std::string& name) {
  for (const TurnClock clock : {TurnClock::Cycles, TurnClock::Seconds}) {
    if (name_of(clock) == name) return clock;
  }
  return bad_input("there is no turn clock `" + name + "`; known are cycles and seconds");
}

/// From the log alone: a flavour that is not built in is in it as a whole.
Expected<Flavour> flavour_of(const LogHead& head, TurnClock turn_clock) {
  if (head.own_flavour.empty()) return find_flavour(head.flavour, turn_clock);
  auto own = parse_flavour(head.own_flavour, head.flavour + ".toml");
  if (!own) return Unexpected(own.error().front());
  own->exploration.turn_clock = turn_clock;
  return std::move(*own);
}

}  // namespace

Expected<LogReplay> replay_log(const RunRecord& record) {
  const LogHead& head = record.head;
  const auto turn_clock = turn_clock_of(head.turn_clock);
  if (!turn_clock) return Unexpected(turn_clock.error());
  const auto flavour = flavour_of(head, *turn_clock);
  if (!flavour) return Unexpected(flavour.error());
  const auto controller = parse_controller(head.machine, *flavour);
  if (!controller) return Unexpected(controller.error());
  // A log is input from outside: it is checked as a node checks its machine.
  if (const auto complaint = complaint_about_running(*controller, *flavour))
    return bad_input(*complaint);
  const auto kind = parse_own_robot(head.own_robot);
  if (!kind) return bad_input("`own_robot` is not a robot: " + kind.error().message);
  // As in the node: modules get the robot's directions, distance between the treads, and maximum
  // speed.
  const Flavour on_robot = fitted(*flavour, *kind);
  ControlSoftware control(*controller, on_robot,
                          control_stream(head.seed, static_cast<int>(head.robot_index)));
  LogReplay replay;
  std::int64_t before = 0;
  for (const LogRow& row : record.rows) {
    // Numbers may be missing, because skipped cycles have no row; none may come twice or out of
    // order.
    if (row.cycle <= before) {
      replay.difference = {row.cycle,
                           fmt::format("cycle {} comes after cycle {}", row.cycle, before)};
      return replay;
    }
    before = row.cycle;
    // The machine did not see these cycles, so it is not stepped. Their readings are only recorded.
    if (row.act == Act::Hold) {
      if (row.command.left_mps != 0 || row.command.right_mps != 0) {
        replay.difference = {row.cycle, "a cycle that was held has a speed"};
        return replay;
      }
      continue;
    }
    SensedSenses senses(row.sensed);
    const Command wanted = control.step(senses);
    ++replay.stepped;
    SWARMSMITH_ASSERT(replay.stepped <= row.cycle, "a controller steps at most once a cycle");
    // The log has the speeds that were sent, after the node's limit.
    // If they are not finite, the node has stopped the treads.
    const Command sent = within_limits(wanted, head.max_mps).value_or(Command{});
    const std::string what = difference(row, sent, control.state(), control.drawn());
    if (what.empty()) continue;
    replay.difference = {row.cycle, what};
    return replay;
  }
  return replay;
}

}  // namespace swarmsmith
