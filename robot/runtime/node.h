#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "robot/runtime/control_clock.h"
#include "robot/runtime/driver_watch.h"
#include "robot/runtime/feeds.h"
#include "robot/runtime/node_state.h"
#include "robot/runtime/order.h"
#include "robot/runtime/run_record.h"
#include "robot/transport/messages.h"
#include "sim/control/control_software.h"
#include "sim/robot/robot.h"

namespace swarmsmith {

/// The settings of a node, in addition to its controller.
struct NodeSettings {
  std::string robot = "rvr1";
  Robot kind = rvr();     ///< no_node_drives has no objection
  int robot_index = 0;    ///< of the random stream, from 0
  std::int64_t seed = 1;  ///< if the order to start has none
  Duration period = std::chrono::milliseconds(100);
  double max_mps = 0.35;  ///< speeds are limited to this
  FeedSettings feeds;
  /// Feeds that are needed in addition to those that the controller uses.
  PerFeed<bool> also_needed{};
  /// When a needed feed is silent for longer than this, it is counted.
  Duration late = std::chrono::milliseconds(150);
  /// When a needed feed is silent for longer than this, the treads stop. Including one period, they
  /// stand within 0.5 s.
  PerFeed<Duration> hold = {std::chrono::milliseconds(300), std::chrono::milliseconds(350),
                            std::chrono::milliseconds(350), std::chrono::milliseconds(350)};
  /// When a needed feed is silent for longer than this, the run ends.
  Duration give_up = std::chrono::seconds(1);
  /// The same limits for a driver that does not obey (it ends the run after `give_up`), and for a
  /// silent operator.
  Duration driver_hold = std::chrono::milliseconds(300);
  Duration operator_hold = std::chrono::milliseconds(300);
  Duration operator_gone = std::chrono::seconds(1);  ///< the run ends after this silence; 0: the
                                                     ///< operator may leave
  double least_battery = 0.2;                        ///< charge, 0 to 1
  std::string lock_step_run = "run";                 ///< names of runs in lock-step are this and
                                                     ///< their seed
  std::string version;
  std::string scheduling;
  std::string host;
  std::vector<std::pair<std::string, std::string>> topics;  ///< for the log
};

/// Both clocks at the same instant.
struct Now {
  TimePoint clock;
  double unix_s = 0;
};

/// The next command to treads and LEDs of a robot, and the row for the log.
struct Decision {
  std::optional<Command> command;  ///< to be sent immediately
  int state = 0;                   ///< of the controller
  std::optional<LogRow> row;
};

/// The logic of a robot's node without transport and clock: it receives messages, is called at its
/// deadlines, and decides. On any error the treads stand still.
class RobotNode {
 public:
  /// `controller` and `flavour` must outlive the node.
  RobotNode(NodeSettings settings, const Controller& controller, const Flavour& flavour);

  Feeds& feeds() { return feeds_; }
  const Feeds& feeds() const { return feeds_; }
  void hear(const BatteryMessage& message);
  /// Obeys or refuses an order; a start that is obeyed arms the node.
  void hear(const Order& order, const Now& now);
  /// Called for a text that is not an order.
  void refuse_order(std::string why) { refused_ = std::move(why); }

  /// The reasons why a run cannot start, each with the name of the missing part; empty: it can.
  std::vector<std::string> not_ready(TimePoint now) const;
  /// The observations of the treads' driver.
  DriverWatch& driver() { return driver_; }

  /// The latest time at which `tick` must be called next.
  TimePoint next_tick(TimePoint now) const;
  /// Begins, steps, holds or ends the run.
  Decision tick(const Now& now);

  /// Numbered lock-step: one cycle of a simulated world, in order from 1; cycle 1 begins a run,
  /// cycle 0 ends the last one. BadInput: the cycle is not the next one.
  Expected<Decision> answer(const SensesMessage& senses, const Now& now);
  /// Counted lock-step: begins the run, and then steps one cycle with the readings of the feeds.
  void begin_counted(const Now& now);
  Decision step_counted(const Now& now);

  /// Called when the world has ended the run.
  void end_run() { end(Phase::Ended); }
  /// Ends any activity; called for a signal or a closed pipe.
  void stop(const std::string& why);
  void fail(const std::string& why);
  /// Cancels an armed run, for example because its log cannot be written.
  void disarm(const std::string& why);
  /// Sets whether the log of a run is being written.
  void set_log_open(bool open) { log_open_ = open; }
  /// Sets the reason why the log cannot be written at present; empty: it can be written again.
  void set_log_trouble(std::string why);
  /// Called when the run is over and its log is incomplete.
  void lose_log();

  Phase phase() const { return phase_; }
  const std::string& run() const { return run_; }
  bool is_on() const { return phase_ == Phase::Armed || phase_ == Phase::Running; }
  bool was_killed() const { return killed_; }
  NodeState state(const Now& now) const;
  /// The head of the run's log; during the run it has no end.
  LogHead head() const;
  std::int64_t cycle() const { return cycle_; }
  const PerFeed<bool>& needed() const { return needed_; }

 private:
  void begin(std::string run, std::int64_t seed, std::int64_t cycles, const Now& start);
  void obey(const Order& order, const Now& now);
  void arm(const Order& order, const Now& now);
  void hear_alive(const Order& order, const Now& now);
  void look_at_clock(const Now& now);
  void end(Phase phase);
  Decision decide(const Now& now);
  Decision step(std::int64_t cycle, Duration late, const Now& now);
  Decision run_cycle(const ControlClock::Beat& beat, const Now& now);
  Decision hold(std::int64_t cycle, Duration late, const Now& now, std::string why);
  LogRow row_of(std::int64_t cycle, Duration late, const Now& now) const;
  /// The needed feed that is silent for longest, relative to its limit.
  struct Silence {
    Feed feed = Feed::Proximity;
    Duration age{};
  };
  std::optional<Silence> silence(TimePoint now, const PerFeed<Duration>& limits) const;
  std::string told(const Silence& silence) const;
  double time_s(TimePoint at) const;
  /// A reason, other than sensors, for the treads to stand still: the driver, or the operator.
  struct Standing {
    std::string what;
    std::int64_t cycles = 0;
    Duration longest{};
    double at_s = 0;  ///< when the longest one began
  };
  void check_treads(const Command& command) const;
  void count(Standing& standing, const std::string& what, TimePoint since, const Now& now);
  Decision hold_and_count(const ControlClock::Beat& beat, const Now& now, const std::string& why);
  std::string silence_of_operator(const Now& now) const;
  void judge();
  void note_driver(RunEnd& end) const;

  NodeSettings settings_;
  const Controller* controller_;
  const Flavour* flavour_;
  Flavour fitted_;         ///< the flavour for this kind of robot
  std::string own_robot_;  ///< the kind as a text; empty for an RVR
  std::string machine_text_;
  std::string machine_digest_;
  PerFeed<bool> needed_;
  Feeds feeds_;
  OrderDoor door_;
  std::optional<double> battery_;
  DriverWatch driver_;
  bool killed_ = false;

  Phase phase_ = Phase::Idle;
  std::string order_;
  std::string refused_;
  std::string log_trouble_;
  bool log_open_ = false;

  // State of the present or the last run.
  std::string run_;
  bool lock_step_ = false;
  std::int64_t seed_ = 1;
  double seconds_ = 0;
  double start_unix_s_ = 0;
  std::optional<double> clock_offset_s_;
  std::optional<ControlClock> clock_;
  std::optional<ControlSoftware> control_;
  TimePoint operator_heard_;
  Now operator_clock_;            ///< an instant of the steady clock here, with the operator's wall
                                  ///< clock at that instant
  double operator_behind_s_ = 0;  ///< how much too early the last order was dated, or 0
  double wall_ahead_s_ = 0;       ///< the wall clock minus the steady one
  std::vector<std::string> clock_steps_;
  std::string new_step_;  ///< for the next row of the log
  Sensed sensed_;
  std::int64_t cycle_ = 0;
  std::int64_t stepped_ = 0;
  std::int64_t held_ = 0;
  std::int64_t skipped_ = 0;
  std::int64_t cut_ = 0;
  Standing by_driver_;
  Standing by_operator_;
  bool driver_failed_ = false;
  PerFeed<std::int64_t> held_for_{};
  PerFeed<Duration> longest_silence_{};
  std::string broken_;  ///< why the run failed or was stopped
  TimePoint last_tick_;
  std::set<std::string, std::less<>> runs_;  ///< runs that were ordered here
  bool log_lost_ = false;
  RunVerdict verdict_ = RunVerdict::Valid;
  std::vector<std::string> reasons_;
};

/// Speeds cut to the limit; nothing when one of them is not finite.
std::optional<Command> within_limits(const Command& command, double max_mps);

}  // namespace swarmsmith
