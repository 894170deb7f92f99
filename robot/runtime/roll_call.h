#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "robot/runtime/node.h"
#include "robot/runtime/node_state.h"
#include "robot/runtime/order.h"
#include "sim/robot/robot.h"

namespace swarmsmith {

/// The operator's information on a robot.
struct RolledRobot {
  std::string name;
  std::optional<NodeState> state;  ///< the last one; none: no message yet
  TimePoint heard;
  int echoes = 0;  ///< number of answered echoes
  /// Its wall clock minus the operator's, measured by the fastest echo, and the duration of that
  /// echo.
  double offset_s = 0;
  double echo_s = 0;
};

/// Asks all robots for their states and measures their clocks with ten echoes each. Pure.
class RollCall {
 public:
  static constexpr int kEchoes = 10;
  static constexpr double kMostOffset_s = 0.02;

  /// `id` is the prefix of the ids of orders, different for each operator.
  RollCall(const std::vector<std::string>& robots, std::string id);

  /// `robot` is its index among the names given to the constructor.
  void hear(std::size_t robot, const NodeState& state, const Now& now);
  /// The echo to send now, if there is one.
  std::optional<Order> tick(const Now& now);
  /// Whether each robot has answered all echoes.
  bool is_complete() const;

  const std::vector<RolledRobot>& robots() const { return robots_; }
  /// The problems that keep the swarm from starting, one per line; also those of nodes that do not
  /// drive this kind of robot, if one is given.
  std::vector<std::string> complaints(TimePoint now, const Robot* kind = nullptr) const;

 private:
  std::vector<RolledRobot> robots_;
  std::string id_;
  int round_ = 0;
  Now sent_;
  std::vector<bool> answered_;  ///< of this round
};

/// Begins a run, watches it, and ends it when a problem occurs with any robot. Pure.
class RunStarter {
 public:
  struct Settings {
    std::string run;
    double seconds = 120;
    std::optional<std::int64_t> seed;
    Robot kind = rvr();     ///< the robot that the run is for
    double lead_s = 2;      ///< time from the order to the agreed instant
    double patience_s = 5;  ///< time limit for the answers of all robots
  };
  enum class Stage {
    Calling,   ///< roll call
    Ordered,   ///< all have received the order, and must report that they are armed
    Watching,  ///< until the run is over
    Stopping,  ///< a problem occurred: all receive the order to stop
    Over,
  };

  RunStarter(Settings settings, const std::vector<std::string>& robots, std::string id,
             const Now& now);

  void hear(std::size_t robot, const NodeState& state, const Now& now);
  /// The orders to send now.
  std::vector<Order> tick(const Now& now);
  /// Called when the operator requests an end.
  void interrupt(const Now& now);

  Stage stage() const { return stage_; }
  bool has_begun() const { return begun_; }
  const RollCall& roll() const { return roll_; }
  /// The reasons why there was no run, or why it was ended; empty: no problem.
  const std::vector<std::string>& complaints() const { return complaints_; }
  /// The agreed start by both clocks of the operator.
  const Now& start() const { return start_; }
  /// The verdict of the whole run: the worst of the robots' verdicts, INVALID when a robot was
  /// lost.
  RunVerdict verdict() const;
  /// Whether the robot's node was in this run and has left it, with its log closed.
  bool is_over_for(const RolledRobot& robot) const;

 private:
  Order order(Order::Kind kind, const Now& now);
  void give_up(std::string why, const Now& now);
  void watch(const Now& now);
  /// Whether the robot's node is in this run and has not left it.
  bool is_in_run(const RolledRobot& robot) const;
  bool has_left(const RolledRobot& robot) const;

  Settings settings_;
  RollCall roll_;
  std::string id_;
  int orders_ = 0;
  Stage stage_ = Stage::Calling;
  bool begun_ = false;
  TimePoint called_;
  Now start_;
  TimePoint stopping_;
  TimePoint alive_;
  std::string start_id_;
  std::vector<std::string> names_;
  std::vector<std::string> complaints_;
};

}  // namespace swarmsmith
