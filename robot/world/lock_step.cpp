#include "robot/world/lock_step.h"

#include <deque>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/overloaded.h"
#include "base/plain_text.h"
#include "robot/world/sensor_messages.h"
#include "sim/control/flavour.h"

namespace swarmsmith {

namespace {

/// Ends a run from inside the engine.
struct RunEnded : std::runtime_error {
  explicit RunEnded(Error why) : std::runtime_error(why.message), error(std::move(why)) {}
  Error error;
};

std::string seconds_text(Duration duration) {
  const auto tenths = std::chrono::duration_cast<std::chrono::milliseconds>(duration).count() / 100;
  return std::to_string(tenths / 10) + (tenths % 10 != 0 ? "." + std::to_string(tenths % 10) : "") +
         " s";
}

class LockStep final : public Decider {
 public:
  LockStep(WorldEnd& end, const SensorTopics& sensors, std::int64_t seed,
           const WorldOptions& options)
      : end_(&end), sensors_(sensors), seed_(seed), options_(&options), robots_(end.robots()) {}

  void ask(const Question& question) override {
    const auto robot = static_cast<std::size_t>(question.robot);
    robots_[robot].asked = question.cycle;
    if (sensors_.senses) return end_->send(robot, senses_message(question, seed_));
    for (const ToRobot& message :
         driver_messages(sensors_, question.senses, stamp_of_time(question.time_s)))
      end_->send(robot, message);
  }

  std::optional<Answer> answer(int index) override {
    const auto robot = static_cast<std::size_t>(index);
    std::deque<Answer>& waiting = robots_[robot].answers;
    const TimePoint until = SystemClock().now() + options_->patience;
    while (waiting.empty())
      hear(robot, until);
    const Answer answer = waiting.front();
    waiting.pop_front();
    return answer;
  }

 private:
  struct Robot {
    std::int64_t asked = 0;  ///< cycle of the last question
    std::deque<Answer> answers{};
  };

  /// Waits for one message while the answer of a robot is missing.
  void hear(std::size_t missing, TimePoint until) {
    constexpr Duration kLook = std::chrono::milliseconds(100);
    const TimePoint now = SystemClock().now();
    if (options_->is_over()) throw RunEnded({ErrorKind::Unavailable, "stopped", {}});
    auto received = end_->receive(std::min(until, now + kLook));
    if (!received) {
      if (SystemClock().now() >= until) throw RunEnded(silence_of(missing));
      return;
    }
    const std::size_t robot = received->robot;
    std::visit(Overloaded{[&](const AnswerMessage& answer) { take(robot, answer); },
                          [&](const WheelsMessage& wheels) { take(robot, wheels); },
                          [&](const TroubleMessage& trouble) {
                            if (trouble.ended)
                              throw RunEnded({ErrorKind::Unavailable, trouble.text, {}});
                            options_->tell(trouble.text);
                          },
                          [](const LedsMessage&) {}, [](const StateMessage&) {}},
               received->message);
  }

  Error silence_of(std::size_t robot) const {
    const bool there = end_->connected(robot);
    return {
        ErrorKind::Unavailable,
        "no answer from " + end_->name(robot) + " in cycle " +
            std::to_string(robots_[robot].asked) + " of seed " + std::to_string(seed_) +
            " within " + seconds_text(options_->patience) +
            (!there            ? "; its node has disconnected: its own messages say why"
             : sensors_.senses ? "; its node is connected, but does not answer"
                               : "; its node is connected, but does not answer: does it wait for "
                                 "a sensor that is not sent, or send its speeds elsewhere "
                                 "(--neighbours, --light, --wheels on both sides)?"),
        end_->name(robot)};
  }

  void take(std::size_t robot, const AnswerMessage& answer) {
    if (!sensors_.senses || robots_[robot].asked == 0) return;  // from an earlier run
    if (answer.seed != seed_ || answer.cycle != robots_[robot].asked ||
        !robots_[robot].answers.empty()) {
      throw RunEnded(
          {ErrorKind::BadInput,
           "was asked about cycle " + std::to_string(robots_[robot].asked) + " of seed " +
               std::to_string(seed_) + ", but answers cycle " + std::to_string(answer.cycle) +
               " of seed " + std::to_string(answer.seed) +
               "; are there two nodes of this name, or is it the node of an earlier run?",
           end_->name(robot)});
    }
    robots_[robot].answers.push_back(
        {.command = {.left_mps = answer.left_mps, .right_mps = answer.right_mps, .leds = {}},
         .state = answer.state});
  }

  void take(std::size_t robot, const WheelsMessage& wheels) {
    // Before the first question a node may send commands to stand still.
    if (sensors_.senses || robots_[robot].asked == 0) return;
    if (!wheels.state) {
      throw RunEnded(
          {ErrorKind::BadInput,
           "sends commands without the controller's state; start its node with --lock-step "
           "topics",
           end_->name(robot)});
    }
    if (!robots_[robot].answers.empty()) {
      throw RunEnded(
          {ErrorKind::BadInput,
           "sends a command without being asked, in cycle " + std::to_string(robots_[robot].asked) +
               "; are there two nodes of this name, or is it the node of an earlier run?",
           end_->name(robot)});
    }
    robots_[robot].answers.push_back(
        {.command = {.left_mps = wheels.left_mps, .right_mps = wheels.right_mps, .leds = {}},
         .state = *wheels.state});
  }

  WorldEnd* end_;
  SensorTopics sensors_;
  std::int64_t seed_;
  const WorldOptions* options_;
  std::vector<Robot> robots_;
};

}  // namespace

SimulationSetup WorldRun::setup() const {
  static const Controller kNone = Machine{.states = {{.behaviour = Stop{}, .transitions = {}}}};
  return {.controller = kNone,
          .flavour = watermelon(),
          .profile = profile,
          .mission = mission,
          .instance = instance,
          .seed = seed};
}

Expected<void> WorldRun::check(const WorldEnd& end) const {
  if (end.robots() == instance.starts.size()) return {};
  return bad_input("the mission has " + counted(instance.starts.size(), "robot") + ", but " +
                   std::to_string(end.robots()) + " are named");
}

Expected<void> wait_for_robots(WorldEnd& end, Duration most, const WorldOptions& options) {
  constexpr Duration kLook = std::chrono::milliseconds(20);
  constexpr Duration kTell = std::chrono::seconds(3);
  const TimePoint begin = SystemClock().now();
  TimePoint told = begin;
  std::vector<bool> known(end.robots(), !options.objection);
  while (true) {
    std::string missing;
    for (std::size_t i = 0; i < end.robots(); ++i) {
      if (!end.connected(i) || !known[i]) missing += (missing.empty() ? "" : ", ") + end.name(i);
    }
    if (missing.empty()) return {};
    const TimePoint now = SystemClock().now();
    if (options.is_over()) return unexpected(ErrorKind::Unavailable, "stopped");
    if (now - begin >= most) {
      return unexpected(ErrorKind::Unavailable, "no node of " + missing + " after " +
                                                    seconds_text(most) +
                                                    "; start them with `swarmsmith-robot run`");
    }
    if (now - told >= kTell) {
      told = now;
      options.tell("waiting for " + missing);
    }
    // Commands from before the start are ignored.
    const auto received = end.receive(now + kLook);
    if (!received) continue;
    const auto* state = std::get_if<StateMessage>(&received->message);
    if (state != nullptr && !known[received->robot]) {
      known[received->robot] = true;
      if (auto why = options.objection(*state)) return bad_input(*why, end.name(received->robot));
    }
    if (const auto* trouble = std::get_if<TroubleMessage>(&received->message)) {
      if (trouble->ended) return unexpected(ErrorKind::Unavailable, trouble->text);
      options.tell(trouble->text);
    }
  }
}

Expected<Measured> run_in_lock_step(WorldEnd& end, const SensorTopics& sensors, const WorldRun& run,
                                    const WorldOptions& options, const Recorder& recorder) {
  if (const auto good = run.check(end); !good) return tl::unexpected(good.error());
  LockStep decider(end, sensors, run.seed, options);
  try {
    return simulate(run.setup(), recorder, &decider);
  } catch (const RunEnded& ended) {
    return tl::unexpected(ended.error);
  } catch (const std::invalid_argument& error) {  // the command is not finite
    return bad_input(error.what());
  }
}

void end_runs(WorldEnd& end) {
  for (std::size_t i = 0; i < end.robots(); ++i)
    end.send(i, SensesMessage{});
  std::vector<bool> heard(end.robots(), false);
  std::size_t missing = end.robots();
  const TimePoint until = SystemClock().now() + std::chrono::seconds(1);
  while (missing > 0) {
    const auto received = end.receive(until);
    if (!received) return;
    const auto* answer = std::get_if<AnswerMessage>(&received->message);
    if (answer == nullptr || answer->cycle != 0 || heard[received->robot]) continue;
    heard[received->robot] = true;
    --missing;
  }
}

}  // namespace swarmsmith
