#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "console/exit_code.h"
#include "robot/log/log_writer.h"
#include "robot/runtime/node.h"
#include "robot/transport/ends.h"

namespace swarmsmith {

/// The wall clock and the steady clock at one instant.
Now now_on_both_clocks();

/// The pace of a node.
enum class Pace {
  Clock,         ///< its own clock, as on a robot
  Senses,        ///< a simulated world sends numbered cycles, and waits for each answer
  CountedTopics  ///< a simulated world sends each sensor's k-th message for cycle k
};

struct LoopOptions {
  Pace pace = Pace::Clock;
  /// The folder of the logs; without it no log is written.
  std::optional<std::filesystem::path> logs;
  /// In lock-step, the longest time that the world may be silent during a run.
  Duration patience = std::chrono::seconds(10);
  /// Called often: whether to end, and by what ("by SIGTERM").
  std::function<std::optional<std::string>()> ends = [] { return std::nullopt; };
  /// Called with remarks for the user.
  std::function<void(const std::string&)> note = [](const std::string&) {};
};

/// Passes messages between a node and its transport, on time, and writes its log. Whatever ends the
/// loop, the last command to the treads is to stand still.
class NodeLoop {
 public:
  /// All must outlive the loop.
  NodeLoop(RobotNode& node, RobotEnd& end, LoopOptions options);

  enum class Ending {
    Asked,       ///< `ends` requested it
    NoMoreRuns,  ///< the world has no more runs
    Lost,        ///< the connection to the transport or the world is lost
    Wrong,       ///< the world sent invalid messages, or the log could not be written
  };
  Ending run();

 private:
  /// Returns false when the loop is over.
  bool turn();
  void set_wall_offset(const Now& now);
  bool turn_by_clock();
  bool turn_in_lock_step();
  void hear(const ToRobot& message);
  void hear_order(const OrderMessage& message);
  void answer(const SensesMessage& senses);
  void step_counted();
  bool all_heard(std::int64_t count) const;
  void carry_out(Decision decision);
  void tend_log();
  void open_log();
  void tell_state(bool at_once);
  void close();
  void finish(Ending ending) { ending_ = ending; }

  RobotNode& node_;
  RobotEnd& end_;
  LoopOptions options_;
  std::optional<Ending> ending_;
  std::unique_ptr<LogWriter> log_;
  bool log_is_ending_ = false;
  std::optional<Leds> leds_;  ///< as last sent
  TimePoint told_at_;
  std::string told_;  ///< the part of the last sent state whose changes must be sent immediately
  TimePoint world_heard_;
  std::string last_trouble_;
  std::string last_refused_;  ///< the last text that was not an order
  std::string last_unknown_;  ///< unknown keys of the last order
};

}  // namespace swarmsmith
