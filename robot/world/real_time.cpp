#include "robot/world/real_time.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <utility>

#include "base/overloaded.h"
#include "robot/transport/messages.h"
#include "robot/world/sensor_messages.h"
#include "robot/world/simulated_driver.h"

namespace swarmsmith {

namespace {

/// Ends the run from inside the engine: with an error, or without one because the nodes' run
/// begins.
struct Broken : std::exception {
  explicit Broken(std::optional<Error> why) : error(std::move(why)) {}
  std::optional<Error> error;
};

std::string time_text(double time_s) {
  char buffer[32];
  const int size = std::snprintf(buffer, sizeof buffer, "%.2f s: ", time_s);
  return {buffer, static_cast<std::size_t>(size)};
}

class Laboratory final : public Decider {
 public:
  Laboratory(WorldEnd& end, const SensorTopics& sensors, const RealTimeOptions& options)
      : end_(&end), sensors_(sensors), options_(&options), robots_(end.robots()) {
    for (std::size_t i = 0; i < robots_.size(); ++i)
      robots_[i].faults.emplace(options.faults, end.name(i));
  }

  /// From now on the robots wait at their start poses.
  void wait_for_start() {
    waits_ = true;
    zero_ = SystemClock().now();
  }
  void begin_at(TimePoint zero) {
    waits_ = false;
    zero_ = zero;
  }
  /// Of the run for which nodes are armed: the last one, if a node still runs an earlier one.
  std::optional<TimePoint> start() const {
    std::optional<TimePoint> last;
    for (const Robot& robot : robots_)
      last = std::max(last, robot.start);  // no start is before all others
    return last;
  }
  /// A node that was killed cannot take back its start.
  void forget_silent(TimePoint now) {
    for (Robot& robot : robots_) {
      if (now - robot.heard > kMostSilence) robot.start.reset();
    }
  }

  bool wants_every_step() const override { return true; }

  /// Receives messages until this time is due.
  void begin(double time_s) override {
    time_s_ = time_s;
    const TimePoint due = zero_ + duration_of(time_s);
    if (waits_) forget_silent(due);
    if (const auto at = start(); waits_ && at && due >= *at) throw Broken(std::nullopt);
    if (options_->is_over()) throw Broken(Error{ErrorKind::Unavailable, "stopped", {}});
    while (const auto received = end_->receive(due))
      hear(*received);
    now_ = SystemClock().now();
    if (!waits_) latest_ = std::max(latest_, now_ - due);
  }

  void ask(const Question& question) override {
    const auto robot = static_cast<std::size_t>(question.robot);
    // Faults apply only during the run.
    const double time_s = waits_ ? -1 : question.time_s;
    const std::int64_t stamp_ns = stamp_now();
    const FaultySensors& faults = *robots_[robot].faults;
    for (ToRobot& message : driver_messages(sensors_, question.senses, stamp_ns)) {
      if (const auto passed = faults.pass(std::move(message), time_s)) end_->send(robot, *passed);
    }
    say_driven(robot);
    if (sensors_.battery) end_->send(robot, BatteryMessage{{{}, stamp_ns}, 7.4, 1});
  }

  std::optional<Answer> answer(int index) override {
    Robot& robot = robots_[static_cast<std::size_t>(index)];
    const auto treads = robot.driver.act(now_);
    // A second node is reported before the start, too: nodes that wait for it report that they
    // stand still.
    const bool rivals_changed = robot.driver.has_rivals() != robot.had_rivals;
    for (const std::string& event : robot.driver.take_events()) {
      if (!waits_ || rivals_changed) {
        options_->tell(time_text(time_s_) + end_->name(static_cast<std::size_t>(index)) + ": " +
                       event);
      }
    }
    stops_by_silence_ += !waits_ && robot.driver.silent() && !robot.was_silent ? 1 : 0;
    stops_by_rivals_ += robot.driver.has_rivals() && !robot.had_rivals ? 1 : 0;
    robot.was_silent = robot.driver.silent();
    robot.had_rivals = robot.driver.has_rivals();
    // Real robots would drive if they got commands while they wait for the start. Here this is an
    // error, because the robots would not start from the mission's poses.
    if (!treads) return std::nullopt;
    say_driven(static_cast<std::size_t>(index));
    if (waits_ && treads->move()) {
      throw Broken(Error{ErrorKind::BadInput,
                         "its node drove before a run was started; the robots have left the places "
                         "where the mission begins",
                         end_->name(static_cast<std::size_t>(index))});
    }
    return Answer{
        .command = {.left_mps = treads->left_mps, .right_mps = treads->right_mps, .leds = {}},
        .state = 0};
  }

  Duration latest() const { return latest_; }
  int stops_by_silence() const { return stops_by_silence_; }
  int stops_by_rivals() const { return stops_by_rivals_; }

 private:
  struct Robot {
    SimulatedDriver driver;
    std::optional<FaultySensors> faults;
    bool was_silent = true;
    bool had_rivals = false;
    std::optional<TimePoint> start;  ///< of the run, while its node is armed or runs
    TimePoint heard;                 ///< its node's last state, before the run
  };

  static std::int64_t stamp_now() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(
               std::chrono::system_clock::now().time_since_epoch())
        .count();
  }

  void say_driven(std::size_t robot) {
    if (!sensors_.driven) return;
    const SimulatedDriver::Treads& treads = robots_[robot].driver.treads();
    end_->send(robot, DrivenMessage{{{}, stamp_now()}, treads.left_mps, treads.right_mps, {}});
  }

  void hear(const WorldEnd::Received& received) {
    std::visit(Overloaded{[&](const WheelsMessage& wheels) {
                            robots_[received.robot].driver.hear(wheels);
                          },
                          [&](const StateMessage& state) {
                            if (!waits_ || !options_->start_of) return;
                            // None where the operator ended the run before its start.
                            robots_[received.robot].start = options_->start_of(state);
                            robots_[received.robot].heard = SystemClock().now();
                          },
                          [&](const TroubleMessage& trouble) {
                            if (trouble.ended)
                              throw Broken(Error{ErrorKind::Unavailable, trouble.text, {}});
                            options_->tell(trouble.text);
                          },
                          [](const LedsMessage&) {}, [](const AnswerMessage&) {}},
               received.message);
  }

  WorldEnd* end_;
  SensorTopics sensors_;
  const RealTimeOptions* options_;
  std::vector<Robot> robots_;
  bool waits_ = false;
  TimePoint zero_{};
  double time_s_ = 0;
  TimePoint now_{};
  Duration latest_{};
  int stops_by_silence_ = 0;
  int stops_by_rivals_ = 0;
};

}  // namespace

Expected<RealTimeResult> run_in_real_time(WorldEnd& end, const SensorTopics& sensors,
                                          const WorldRun& run, const RealTimeOptions& options,
                                          const Recorder& recorder) {
  if (const auto good = run.check(end); !good) return tl::unexpected(good.error());
  Laboratory laboratory(end, sensors, options);
  try {
    TimePoint zero = SystemClock().now();
    if (options.start_of) {
      Mission before = run.mission;
      before.cycles = std::numeric_limits<int>::max();
      laboratory.wait_for_start();
      try {
        const WorldRun waiting{run.profile, before, run.instance, run.seed};
        simulate(waiting.setup(), {}, &laboratory);
      } catch (const Broken& broken) {
        if (broken.error) throw;
      }
      zero = *laboratory.start();
    }
    laboratory.begin_at(zero);
    const Measured result = simulate(run.setup(), recorder, &laboratory);
    return RealTimeResult{.simulation = result,
                          .start = zero,
                          .latest = laboratory.latest(),
                          .stops_by_silence = laboratory.stops_by_silence(),
                          .stops_by_rivals = laboratory.stops_by_rivals()};
  } catch (const Broken& broken) {
    return tl::unexpected(*broken.error);
  } catch (const std::invalid_argument& error) {
    return bad_input(error.what());
  }
}

}  // namespace swarmsmith
