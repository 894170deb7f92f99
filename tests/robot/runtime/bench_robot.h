#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "robot/runtime/node.h"
#include "sim/control/controller.h"
#include "sim/control/flavour.h"

namespace swarmsmith {

/// A machine that looks at everything but light: it explores, and follows neighbours on black.
inline constexpr const char* kCuriousMachine =
    "--nstates 2 --s0 0 --rwm0 10 --n0 1 --n0x0 0 --c0x0 0 --p0x0 0.8 "
    "--s1 2 --att1 2 --n1 1 --n1x0 0 --c1x0 5 --p1x0 0.1";

/// Goes towards light, which it needs beside its proximity sensors: a machine of `chocolate`.
inline constexpr const char* kLightMachine = "--nstates 1 --s0 2";

/// A row with all its fields, for comparisons.
inline std::string text_of(const LogRow& row) {
  const auto rgb = [](const Rgb& color) {
    return fmt::format("({} {} {})", color.r, color.g, color.b);
  };
  const auto feeds = [](const PerFeed<std::optional<double>>& numbers) {
    std::string text;
    for (const auto& number : numbers)
      text += number ? fmt::format(" {:.6g}", *number) : " -";
    return text;
  };
  std::string text = fmt::format("{} at {:.6f} late {:.6g} ms {} state {} speeds {} {} leds",
                                 row.cycle, row.clock_s, row.late_ms, name_of(row.act), row.state,
                                 row.command.left_mps, row.command.right_mps);
  for (const Rgb& led : row.command.leds)
    text += rgb(led);
  text += fmt::format(" time {:.9g} proximity", row.sensed.time_s);
  for (const double distance : row.sensed.proximity_m)
    text += fmt::format(" {}", distance);
  text += " ground " + rgb(row.sensed.ground) + " neighbours";
  for (const Neighbour& one : row.sensed.neighbours)
    text += fmt::format(" ({} {} {})", one.distance_m, one.direction_x, one.direction_y);
  text += " lux";
  for (const double lux : row.sensed.light_lux)
    text += fmt::format(" {}", lux);
  return text + fmt::format(" sent ({} {} {}) ages{} stamps{} drawn {}: {}", row.ground_as_sent.r,
                            row.ground_as_sent.g, row.ground_as_sent.b, feeds(row.age_ms),
                            feeds(row.stamp_ms), row.drawn, row.event);
}

/// A node on a bench, with a clock of its own that only the test moves, and drivers that send each
/// 100 ms.
class BenchRobot {
 public:
  explicit BenchRobot(NodeSettings settings = {}, const std::string& machine = kCuriousMachine,
                      const Flavour& flavour = watermelon())
      : flavour_(flavour),
        controller_(parse_controller(machine, flavour_).value()),
        settings_(std::move(settings)),
        node(settings_, controller_, flavour_) {}

  Now now() const { return {clock, unix_s() + wall_ahead_s}; }
  double unix_s() const { return std::chrono::duration<double>(clock.time_since_epoch()).count(); }

  void send_ranges(double distance = std::numeric_limits<double>::infinity()) {
    node.feeds().hear(RangesMessage{{clock, 0}, std::vector<double>(8, distance)});
  }
  void send_ground(double gray = 127) {
    node.feeds().hear(GroundColorMessage{{clock, 0}, gray, gray, gray});
  }
  void send_light() { node.feeds().hear(LightMessage{{clock, 0}, {0, 0, 0, 500, 0, 0, 0, 0}}); }
  void send_neighbours() { node.feeds().hear(NeighboursMessage{{clock, 0}, {{0.5, 0.6, 0.8}}}); }
  void send_all() {
    if (ranges) send_ranges();
    if (ground) send_ground();
    if (neighbours) send_neighbours();
    if (light) send_light();
  }

  void send_driver() {
    node.driver().set_listeners({{"driver", clock}}, clock);
    if (!obeys) return;
    node.driver().hear(DrivenMessage{{clock, 0}, treads.left_mps, treads.right_mps, "driver"});
  }

  Decision tick() {
    Decision decision = node.tick(now());
    if (decision.row) rows.push_back(*decision.row);
    if (decision.command) treads = *decision.command;
    return decision;
  }

  /// One period: drivers send, the operator is heard, the node is ticked `late` behind its time.
  Decision cycle(Duration late = {}) {
    clock += settings_.period;
    send_all();
    send_driver();
    if (alive) node.hear(order(Order::Kind::Alive), now());
    clock += late;
    Decision decision = tick();
    clock -= late;
    return decision;
  }

  void cycles(int count) {
    for (int i = 0; i < count; ++i)
      cycle();
  }

  Order order(Order::Kind kind) {
    Order made;
    made.kind = kind;
    made.id = "bench-" + std::to_string(++orders_);
    made.run = run;
    made.sent_unix_s = unix_s() + operator_ahead_s;
    made.at_unix_s = unix_s() + 1;
    made.seconds = seconds;
    return made;
  }

  /// To the start, which lies at a whole cycle.
  void start() {
    cycles(2);
    node.hear(order(Order::Kind::Start), now());
    cycles(10);
  }

  NodeState state() const { return node.state(now()); }
  double speed() const { return std::max(std::fabs(treads.left_mps), std::fabs(treads.right_mps)); }

  TimePoint clock{std::chrono::seconds(1000)};
  double wall_ahead_s = 0;
  double operator_ahead_s = 0;  ///< its clock
  std::string run = "run07";
  double seconds = 30;
  bool ranges = true;
  bool ground = true;
  bool neighbours = true;
  bool light = false;
  bool alive = true;
  bool obeys = true;  ///< its driver, which says so
  Command treads;
  std::vector<LogRow> rows;

 private:
  Flavour flavour_;
  Controller controller_;
  NodeSettings settings_;
  int orders_ = 0;

 public:
  RobotNode node;
};

}  // namespace swarmsmith
