#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "robot/runtime/node.h"
#include "robot/runtime/node_state.h"
#include "robot/runtime/order.h"

namespace swarmsmith {

/// A robot as the operator knows it.
struct RolledRobot {
  std::string name;
  std::optional<NodeState> state;  ///< the last one; none: never heard
  TimePoint heard;
  int echoes = 0;  ///< answered
  /// Its wall clock minus the operator's, by the quickest echo, which took so long.
  double offset_s = 0;
  double echo_s = 0;
};

/// Asks all robots for their states and measures their clocks by ten echoes each. Pure.
class RollCall {
 public:
  static constexpr int kEchoes = 10;
  static constexpr double kMostOffset_s = 0.02;

  /// `id`: begins the ids of orders; no two operators' are equal.
  RollCall(const std::vector<std::string>& robots, std::string id);

  /// `robot`: its place among those of the constructor.
  void hear(std::size_t robot, const NodeState& state, const Now& now);
  /// The echo to be sent now, if one is.
  std::optional<Order> tick(const Now& now);
  /// Each robot has answered all echoes.
  bool is_complete() const;

  const std::vector<RolledRobot>& robots() const { return robots_; }
  /// What is wrong with a swarm that shall start, a line each.
  std::vector<std::string> complaints(TimePoint now) const;

 private:
  std::vector<RolledRobot> robots_;
  std::string id_;
  int round_ = 0;
  Now sent_;
  std::vector<bool> answered_;  ///< of this round
};

/// Begins a run, watches over it, and ends it when something goes wrong with any robot. Pure.
class RunStarter {
 public:
  struct Settings {
    std::string run;
    double seconds = 120;
    std::optional<std::int64_t> seed;
    double lead_s = 2;      ///< from the order to the agreed instant
    double patience_s = 5;  ///< until all robots have answered
  };
  enum class Stage {
    Calling,   ///< roll call
    Ordered,   ///< all have the order, and are to say that they are armed
    Watching,  ///< until the run is over
    Stopping,  ///< something went wrong: all get the order to stop
    Over,
  };

  RunStarter(Settings settings, const std::vector<std::string>& robots, std::string id,
             const Now& now);

  void hear(std::size_t robot, const NodeState& state, const Now& now);
  /// Orders to be sent now.
  std::vector<Order> tick(const Now& now);
  /// The operator wants an end.
  void interrupt(const Now& now);

  Stage stage() const { return stage_; }
  bool has_begun() const { return begun_; }
  const RollCall& roll() const { return roll_; }
  /// Why there was no run, or why it was ended; empty: all went well.
  const std::vector<std::string>& complaints() const { return complaints_; }
  /// The agreed instant by both clocks of the operator.
  const Now& start() const { return start_; }
  /// Of the whole run: the worst of the robots', INVALID when one was lost.
  RunVerdict verdict() const;
  /// Whether the robot's node was in this run and has left it, and its log is closed.
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
