#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
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
  void send_neighbours() { node.feeds().hear(NeighboursMessage{{clock, 0}, {{0.5, 0.6, 0.8}}}); }
  void send_all() {
    if (ranges) send_ranges();
    if (ground) send_ground();
    if (neighbours) send_neighbours();
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
