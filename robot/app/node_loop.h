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

/// The wall clock and the steady one, at one instant.
Now now_on_both_clocks();

/// How a node is driven.
enum class Pace {
  Clock,         ///< its own clock: on a robot
  Senses,        ///< a simulated world sends cycles by number, and waits for each answer
  CountedTopics  ///< a simulated world sends each sensor's k-th message for cycle k
};

struct LoopOptions {
  Pace pace = Pace::Clock;
  /// Where logs go; none: nowhere.
  std::optional<std::filesystem::path> logs;
  /// In lock-step, how long the world may be silent during a run.
  Duration patience = std::chrono::seconds(10);
  /// Is asked often: whether to end, and by what ("by SIGTERM").
  std::function<std::optional<std::string>()> ends = [] { return std::nullopt; };
  /// What a person should know.
  std::function<void(const std::string&)> note = [](const std::string&) {};
};

/// Carries messages between a node and its transport, on time, and writes its log. Whatever ends
/// it, the last thing that the treads hear is to stand still.
class NodeLoop {
 public:
  /// All must outlive the loop.
  NodeLoop(RobotNode& node, RobotEnd& end, LoopOptions options);

  enum class Ending {
    Asked,       ///< `ends` said so
    NoMoreRuns,  ///< the world has no more
    Lost,        ///< the transport or the world
    Wrong,       ///< the world sent what cannot be, or the log could not be written
  };
  Ending run();

 private:
  /// False: the loop is over.
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
  std::optional<Leds> leds_;  ///< as sent
  TimePoint told_at_;
  std::string told_;  ///< of what was told, the part that must be told when it changes
  TimePoint world_heard_;
  std::string last_trouble_;
  std::string last_refused_;  ///< of texts that are not orders
  std::string last_unknown_;  ///< keys of orders
};

}  // namespace swarmsmith
