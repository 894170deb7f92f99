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

namespace swarmsmith {

/// What a node obeys besides its controller.
struct NodeSettings {
  std::string robot = "rvr1";
  int robot_index = 0;    ///< of the random stream, from 0
  std::int64_t seed = 1;  ///< when the order to start has none
  Duration period = std::chrono::milliseconds(100);
  double max_mps = 0.35;  ///< speeds are cut to this
  FeedSettings feeds;
  /// Needed besides what the controller asks for.
  PerFeed<bool> also_needed{};
  /// A needed feed that is silent for longer is counted,
  Duration late = std::chrono::milliseconds(150);
  /// for longer stops the treads,
  PerFeed<Duration> hold = {std::chrono::milliseconds(300), std::chrono::milliseconds(350),
                            std::chrono::milliseconds(350), std::chrono::milliseconds(350)};
  /// and for longer ends the run. With a period on top the treads stand within 0.5 s.
  Duration give_up = std::chrono::seconds(1);
  /// The same of a driver that does not obey (it ends the run after `give_up`), and of the
  /// operator.
  Duration driver_hold = std::chrono::milliseconds(300);
  Duration operator_hold = std::chrono::milliseconds(300);
  Duration operator_gone = std::chrono::seconds(1);  ///< 0: the operator may go
  double least_battery = 0.2;                        ///< charge, 0 to 1
  std::string lock_step_run = "run";                 ///< runs in lock-step are this and their seed
  std::string version;
  std::string scheduling;
  std::string host;
  std::vector<std::pair<std::string, std::string>> topics;  ///< for the log
};

/// Both clocks at one instant.
struct Now {
  TimePoint clock;
  double unix_s = 0;
};

/// What the treads and LEDs of a robot shall do, and what is written down.
struct Decision {
  std::optional<Command> command;  ///< to be sent now
  int state = 0;                   ///< of the controller
  std::optional<LogRow> row;
};

/// A robot's node without its surroundings: it hears messages, is ticked at its deadlines, and says
/// what to do. Whatever goes wrong, the treads stand still.
class RobotNode {
 public:
  /// `controller` and `flavour` must outlive the node.
  RobotNode(NodeSettings settings, const Controller& controller, const Flavour& flavour);

  Feeds& feeds() { return feeds_; }
  const Feeds& feeds() const { return feeds_; }
  void hear(const BatteryMessage& message);
  /// Obeys or refuses; a start that is obeyed arms the node.
  void hear(const Order& order, const Now& now);
  /// Text that is not an order.
  void refuse_order(std::string why) { refused_ = std::move(why); }

  /// Why no run can start, by name of what is missing; empty: it can.
  std::vector<std::string> not_ready(TimePoint now) const;
  /// What is known of who drives the treads.
  DriverWatch& driver() { return driver_; }

  /// When the node wants to be ticked next, at the latest.
  TimePoint next_tick(TimePoint now) const;
  /// Begins, steps, holds or ends the run.
  Decision tick(const Now& now);

  /// Lock-step: one cycle of a simulated world, in order from 1; cycle 1 begins a run, cycle 0 ends
  /// the last one. BadInput: a cycle that is not the next.
  Expected<Decision> answer(const SensesMessage& senses, const Now& now);
  /// Lock-step by counting: begins the run, and then steps one cycle with what the feeds have.
  void begin_counted(const Now& now);
  Decision step_counted(const Now& now);

  /// The world has ended the run.
  void end_run() { end(Phase::Ended); }
  /// Ends whatever is going on; what a signal or a closed pipe does.
  void stop(const std::string& why);
  void fail(const std::string& why);
  /// A run that was armed does not begin: why its log cannot be written, say.
  void disarm(const std::string& why);
  /// Whether a run's log is being written.
  void set_log_open(bool open) { log_open_ = open; }
  /// The log cannot be written at present, or (empty) it can again.
  void set_log_trouble(std::string why);
  /// The run is over and its log is not whole.
  void lose_log();

  Phase phase() const { return phase_; }
  const std::string& run() const { return run_; }
  bool is_on() const { return phase_ == Phase::Armed || phase_ == Phase::Running; }
  bool was_killed() const { return killed_; }
  NodeState state(const Now& now) const;
  /// The head of the run's log; without an end while it goes on.
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
  /// The needed feed that is silent for longest, measured in what it may be.
  struct Silence {
    Feed feed = Feed::Proximity;
    Duration age{};
  };
  std::optional<Silence> silence(TimePoint now, const PerFeed<Duration>& limits) const;
  std::string told(const Silence& silence) const;
  double time_s(TimePoint at) const;
  /// Why the treads stand, besides sensors: the driver, or the operator.
  struct Standing {
    std::string what;
    std::int64_t cycles = 0;
    Duration longest{};
    double at_s = 0;  ///< when that began
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

  // Of the present or the last run.
  std::string run_;
  bool lock_step_ = false;
  std::int64_t seed_ = 1;
  double seconds_ = 0;
  double start_unix_s_ = 0;
  std::optional<double> clock_offset_s_;
  std::optional<ControlClock> clock_;
  std::optional<ControlSoftware> control_;
  TimePoint operator_heard_;
  Now operator_clock_;            ///< a steady instant here, and the operator's wall clock then
  double operator_behind_s_ = 0;  ///< so much too early the last order was dated, if it was
  double wall_ahead_s_ = 0;       ///< the wall clock minus the steady one
  std::vector<std::string> clock_steps_;
  std::string new_step_;  ///< for the log's next row
  Sensed sensed_;
  std::int64_t cycle_ = 0;
  std::int64_t stepped_ = 0;
  std::int64_t held_ = 0;
  std::int64_t skipped_ = 0;
  std::int64_t late_readings_ = 0;
  std::int64_t cut_ = 0;
  Standing by_driver_;
  Standing by_operator_;
  bool driver_failed_ = false;
  PerFeed<std::int64_t> held_for_{};
  PerFeed<Duration> longest_silence_{};
  std::string broken_;  ///< why it failed or was stopped
  TimePoint last_tick_;
  std::set<std::string, std::less<>> runs_;  ///< that began here
  bool log_lost_ = false;
  RunVerdict verdict_ = RunVerdict::Valid;
  std::vector<std::string> reasons_;
};

/// Speeds within the limit, or nothing when one of them is not a finite number.
std::optional<Command> within_limits(const Command& command, double max_mps);

}  // namespace swarmsmith
