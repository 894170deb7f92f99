#include "sim/engine/simulate.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <deque>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "base/assert.h"
#include "base/hash.h"
#include "base/rng.h"
#include "sim/control/used_senses.h"
#include "sim/engine/fitting.h"
#include "sim/engine/internal/float32.h"
#include "sim/engine/internal/noise_stream.h"
#include "sim/engine/internal/robot_clock.h"
#include "sim/engine/internal/robot_senses.h"
#include "sim/engine/internal/sight.h"
#include "sim/engine/internal/world.h"
#include "sim/mission/score.h"

namespace swarmsmith {
namespace {

/// A command on its way to the treads.
struct LateCommand {
  std::int64_t from = 0;  ///< sub-step from which it acts
  Command command;
};

/// Copies the treads' part of `from` to `to`. It copies member by member: after a copy in one
/// piece, the next read of a member would stall.
void renew_treads(Command& to, const Command& from) {
  to.left_mps = from.left_mps;
  to.right_mps = from.right_mps;
}

/// The fractions of a command that a robot really drives and turns.
struct Grip {
  double way = 1;
  double turn = 1;

  /// The speeds of treads without slip that would move the robot in the same way.
  Command of(const Command& command) const {
    const double ahead_mps = way * (command.left_mps + command.right_mps) / 2;
    const double turning_mps = turn * (command.right_mps - command.left_mps) / 2;
    Command gripped;
    gripped.left_mps = ahead_mps - turning_mps;
    gripped.right_mps = ahead_mps + turning_mps;
    return gripped;
  }
};

bool slips(const Treads& treads) {
  return treads.way != 1 || treads.turn != 1 || treads.way_sd > 0 || treads.turn_sd > 0;
}

/// Whether a number of the profile whose name begins with this text is a range.
bool has_range(const Profile& profile, std::string_view begin) {
  return std::ranges::any_of(
      profile.ranges, [&](const FieldRange& range) { return range.field.starts_with(begin); });
}

/// Each draw has its own stream, so that slip changes no other noise of the run. A negative
/// fraction would drive against the command.
Grip grip_of_run(const Treads& treads, const Rng& run, int robot) {
  Rng way = run.split("way", static_cast<std::uint64_t>(robot));
  Rng turn = run.split("turn", static_cast<std::uint64_t>(robot));
  return {.way = std::max(0.0, way.normal(treads.way, treads.way_sd)),
          .turn = std::max(0.0, turn.normal(treads.turn, treads.turn_sd))};
}

/// Replaces the controller when a decider decides.
const Controller& idle() {
  static const Controller kIdle = Machine{.states = {{.behaviour = Stop{}, .transitions = {}}}};
  return kIdle;
}

/// All sensors that may be requested in this run.
Sensors sensors_of_run(const SimulationSetup& setup, const Recorder& recorder,
                       const Decider* decider) {
  if (decider != nullptr) return Sensors::all();
  Sensors sensors = recorder.sensors;
  const UsedSenses used = senses_used_by(setup.controller, setup.flavour);
  if (used.ground_color) sensors = sensors | Sensor::GroundColor;
  if (used.neighbours) sensors = sensors | Sensor::Neighbours;
  return sensors;
}

/// A robot with the parts it needs to act on its own clock.
struct Agent {
  RobotSenses senses;
  ControlSoftware control;
  RobotClock clock;
  int state = 0;                       ///< from the last answer of a decider
  std::int64_t cycle = 0;              ///< control cycles so far
  Command command{};                   ///< the last command computed
  Command acting{};                    ///< the command that the drive follows; only the treads'
                                       ///< part
  std::deque<LateCommand> late{};      ///< oldest first
  const Readings* readings = nullptr;  ///< the readings that the recorder requested

  /// The next sub-step at which something happens to this robot.
  std::int64_t next_event() const {
    return late.empty() ? clock.next() : std::min(clock.next(), late.front().from);
  }
};

class Run {
 public:
  Run(const SimulationSetup& setup, const Recorder& recorder, Decider* decider)
      : setup_(setup),
        recorder_(recorder),
        decider_(decider),
        every_step_(decider != nullptr && decider->wants_every_step()),
        stops_more_(decider != nullptr || setup.profile.timing.driver_sub_steps > 0 ||
                    setup.profile.neighbours.every_sub_steps > 0),
        distorts_commands_(setup.profile.float32_wire || setup.profile.treads.step_mps > 0 ||
                           has_range(setup.profile, "treads.step")),
        slips_(slips(setup.profile.treads) || has_range(setup.profile, "treads.")),
        disturbs_(setup.profile.treads.sd > 0 || has_range(setup.profile, "treads.sd")),
        flavour_(fitted(setup.flavour, setup.mission.robot)),
        arena_(arena_of(setup.mission, setup.instance)),
        world_(arena_, setup.mission.robot, setup.instance.starts, setup.profile.contacts),
        scorer_(setup.mission.rule, arena_),
        positions_(setup.instance.starts.size()),
        object_positions_(arena_.objects.size()) {
    const Rng run(static_cast<std::uint64_t>(setup.seed));
    agents_.reserve(positions_.size());
    const Sensors sensors = sensors_of_run(setup, recorder, decider);
    if (!setup.profile.ranges.empty()) {
      for (int i = 0; i < world_.robots(); ++i)
        profiles_.push_back(drawn_profile(setup.profile, run, i));
    }
    for (int i = 0; i < world_.robots(); ++i) {
      agents_.push_back({.senses = RobotSenses(world_, arena_, profile_of(i), i, run,
                                               setup.flavour.floor.any_channel),
                         .control = ControlSoftware(decider == nullptr ? setup.controller : idle(),
                                                    flavour_, control_stream(setup.seed, i)),
                         .clock = RobotClock(profile_of(i).timing, run, i)});
      next_events_.push_back(agents_.back().next_event());
      agents_.back().senses.remember(sensors);
      if (slips_) grips_.push_back(grip_of_run(profile_of(i).treads, run, i));
      if (disturbs_) wheel_noises_.emplace_back(run, "wheels", i);
    }
  }

  Measured run() {
    record(0);
    std::int64_t now = 0;
    for (int instant = 1; instant <= setup_.mission.cycles; ++instant) {
      const std::int64_t end = std::int64_t{instant} * kSubStepsPerInstant;
      while (now < end) {
        std::int64_t next = end;
        if (stops_more_) [[unlikely]]
          next = next_stop(now, end);
        for (const std::int64_t event : next_events_)
          next = std::min(next, event);
        world_.advance(static_cast<int>(next - now));
        now = next;
        check(now);
        if (stops_more_) [[unlikely]]
          attend(now);
        for (int i = 0; i < world_.robots(); ++i) {
          if (next_events_[static_cast<std::size_t>(i)] == now) serve(i, now);
        }
      }
      observe();
      record(instant);
    }
    return {.score = scorer_.score(), .state_digest = digest()};
  }

 private:
  const Profile& profile_of(int robot) const {
    return profiles_.empty() ? setup_.profile : profiles_[static_cast<std::size_t>(robot)];
  }

  int index_of(const Agent& agent) const { return static_cast<int>(&agent - agents_.data()); }

  /// Without this check, sensors, scores and digests would silently continue with NaN.
  void check(std::int64_t now) const {
    const int unsound = world_.find_unsound();
    if (unsound >= 0) [[unlikely]]
      break_down(unsound, now);
  }

  [[noreturn]] void break_down(int mover, std::int64_t now) const {
    const int object = mover - world_.robots();
    const std::string name =
        object < 0 ? "robot " + std::to_string(mover) : "object " + std::to_string(object);
    const std::int64_t cycle = (now + kSubStepsPerInstant - 1) / kSubStepsPerInstant;
    throw std::runtime_error("the simulation broke down: in cycle " + std::to_string(cycle) +
                             " of seed " + std::to_string(setup_.seed) + " " + name +
                             " has no finite pose and velocity any more; this is a defect of the "
                             "simulator: please report it with the machine, the mission and the "
                             "profile");
  }

  /// Handles the events of a robot at this sub-step: its control cycle, then late commands.
  void serve(int robot, std::int64_t now) {
    Agent& agent = agents_[static_cast<std::size_t>(robot)];
    bool acts = false;
    while (agent.clock.next() == now) {  // repeated for a period shorter than a sub-step
      decide(agent, now);
      agent.clock.next_cycle();
      acts = true;
    }
    bool arrived = false;
    while (!agent.late.empty() && agent.late.front().from <= now) {
      renew_treads(agent.acting, agent.late.front().command);
      agent.late.pop_front();
      arrived = true;
    }
    // An old command is renewed, too: its direction follows the heading, cycle by cycle.
    if (acts || arrived) drive(robot, agent.acting);
    next_events_[static_cast<std::size_t>(robot)] = agent.next_event();
  }

  static double time_s_at(std::int64_t now) { return kSubStep_s * static_cast<double>(now); }

  /// One control cycle: read, decide, and send the command. A command without latency acts from the
  /// instant at which its readings were taken: in terms of the original simulator, the result of
  /// tick t moves the robot during tick t+1.
  void decide(Agent& agent, std::int64_t now) {
    begin_cycle(agent, now);
    accept(agent, agent.control.step(agent.senses), now);
    if (!recorder_.sensors.empty()) agent.readings = &agent.senses.read(recorder_.sensors);
  }

  static void begin_cycle(Agent& agent, std::int64_t now) {
    ++agent.cycle;
    agent.senses.begin_cycle(
        {.number = agent.cycle, .time_s = time_s_at(now), .acted = agent.acting});
  }

  /// Sends a command on its way.
  [[gnu::always_inline]] void accept(Agent& agent, const Command& command, std::int64_t now) {
    const double most_mps = world_.robot().drive.max_speed_mps;
    agent.command.left_mps = within_wheel_speed(command.left_mps, most_mps);
    agent.command.right_mps = within_wheel_speed(command.right_mps, most_mps);
    if (distorts_commands_) [[unlikely]]
      distort(agent.command, profile_of(index_of(agent)));
    if (recorder_.observe) agent.command.leds = command.leds;  // only the recorder sees LEDs
    const std::int64_t arrival = agent.clock.arrival_of_command(now);
    if (!wheel_noises_.empty()) [[unlikely]]
      return send(agent, disturbed(agent), arrival, now);
    send(agent, agent.command, arrival, now);
  }

  /// RobotClock keeps the order of commands, so the queue is sorted by arrival. Of commands that
  /// arrive at the same sub-step only the last one counts.
  static void send(Agent& agent, const Command& command, std::int64_t arrival, std::int64_t now) {
    if (arrival == now && agent.late.empty()) {
      renew_treads(agent.acting, command);
    } else if (!agent.late.empty() && agent.late.back().from == arrival) {
      agent.late.back().command = command;
    } else {
      agent.late.push_back({arrival, command});
    }
  }

  /// The command with independent noise on each wheel.
  [[gnu::noinline]] Command disturbed(const Agent& agent) const {
    const int robot = index_of(agent);
    const auto first = 2 * static_cast<std::uint64_t>(agent.cycle);
    const double sd = profile_of(robot).treads.sd;
    Command command = agent.command;
    const NoiseStream& noise = wheel_noises_[static_cast<std::size_t>(robot)];
    command.left_mps *= 1 + sd * noise.normal(first);
    command.right_mps *= 1 + sd * noise.normal(first + 1);
    return command;
  }

  /// Applies the errors of a command on its way to the treads.
  [[gnu::noinline]] void distort(Command& command, const Profile& profile) const {
    for (double* speed_mps : {&command.left_mps, &command.right_mps}) {
      if (profile.float32_wire) *speed_mps = as_float32(*speed_mps);
      const double step_mps = profile.treads.step_mps;
      if (step_mps > 0)
        *speed_mps = within_wheel_speed(std::round(*speed_mps / step_mps) * step_mps,
                                        world_.robot().drive.max_speed_mps);
    }
  }

  /// The next sub-step, up to `end`, at which `attend` has work in addition to the events of the
  /// robots.
  [[gnu::noinline]] std::int64_t next_stop(std::int64_t now, std::int64_t end) const {
    std::int64_t next = every_step_ ? now + 1 : end;
    for (const Agent& agent : agents_)
      next = std::min(next, agent.senses.next_beat());
    return next;
  }

  /// Readings that are held, and the decider, come before the events of the robots.
  [[gnu::noinline]] void attend(std::int64_t now) {
    for (Agent& agent : agents_)
      agent.senses.read_at_beat(now);
    if (decider_ != nullptr) consult(now);
  }

  /// The control cycles of all robots at this sub-step, with a decider: asks about the robots that
  /// are due, then takes the answers.
  void consult(std::int64_t now) {
    find_due(now);
    if (due_.empty() && !every_step_) return;
    decider_->begin(time_s_at(now));
    if (every_step_) {
      for (const int robot : due_)
        ask(robot, now);
      for (int i = 0; i < world_.robots(); ++i)
        take_answer(i, now);
      end_cycles();
      find_due(now);
    }
    for (; !due_.empty(); find_due(now)) {  // repeated for a period shorter than a sub-step
      for (const int robot : due_)
        ask(robot, now);
      for (const int robot : due_)
        take_answer(robot, now);
      end_cycles();
    }
  }

  /// Finds the robots that have a control cycle, or another one, at this sub-step.
  void find_due(std::int64_t now) {
    due_.clear();
    for (int i = 0; i < world_.robots(); ++i) {
      if (agents_[static_cast<std::size_t>(i)].clock.next() == now) due_.push_back(i);
    }
  }

  void end_cycles() {
    for (const int robot : due_) {
      agents_[static_cast<std::size_t>(robot)].clock.next_cycle();
      follow(robot);
    }
  }

  /// The drive follows the acting command.
  void follow(int robot) {
    const Agent& agent = agents_[static_cast<std::size_t>(robot)];
    drive(robot, agent.acting);
    next_events_[static_cast<std::size_t>(robot)] = agent.next_event();
  }

  void drive(int robot, const Command& acting) {
    if (slips_) [[unlikely]] {
      world_.command(robot, grips_[static_cast<std::size_t>(robot)].of(acting));
    } else {
      world_.command(robot, acting);
    }
  }

  void ask(int robot, std::int64_t now) {
    Agent& agent = agents_[static_cast<std::size_t>(robot)];
    begin_cycle(agent, now);
    decider_->ask(
        {.robot = robot, .cycle = agent.cycle, .time_s = time_s_at(now), .senses = agent.senses});
    if (!recorder_.sensors.empty()) agent.readings = &agent.senses.read(recorder_.sensors);
  }

  void take_answer(int robot, std::int64_t now) {
    const std::optional<Decider::Answer> answer = decider_->answer(robot);
    if (!answer) return;
    const Command& command = answer->command;
    if (!std::isfinite(command.left_mps) || !std::isfinite(command.right_mps)) {
      throw std::invalid_argument("the decision for robot " + std::to_string(robot) + " at " +
                                  std::to_string(time_s_at(now)) +
                                  " s has no finite speeds for the treads");
    }
    Agent& agent = agents_[static_cast<std::size_t>(robot)];
    agent.state = answer->state;
    accept(agent, command, now);
    follow(robot);
  }

  int state_of(const Agent& agent) const {
    return decider_ == nullptr ? agent.control.state() : agent.state;
  }

  /// The point of a robot that the score uses.
  Point scored_point(const Body& body) const {
    const TrackedPoint& tracking = setup_.profile.tracking;
    if (!tracking.scores_tag) return {body.x, body.y};
    return {body.x + body.cos * tracking.tag.x - body.sin * tracking.tag.y,
            body.y + body.sin * tracking.tag.x + body.cos * tracking.tag.y};
  }

  void observe() {
    for (int i = 0; i < world_.robots(); ++i)
      positions_[static_cast<std::size_t>(i)] = scored_point(world_.body(i));
    for (int i = 0; i < world_.movers() - world_.robots(); ++i) {
      const Body& body = world_.body(world_.robots() + i);
      object_positions_[static_cast<std::size_t>(i)] = {body.x, body.y};
    }
    scorer_.observe(positions_, object_positions_);
  }

  void record(int instant) {
    if (!recorder_.observe) return;
    records_.clear();
    for (int i = 0; i < world_.robots(); ++i) {
      const Agent& agent = agents_[static_cast<std::size_t>(i)];
      records_.push_back({.pose = instant == 0 ? setup_.instance.starts[static_cast<std::size_t>(i)]
                                               : pose_of(world_.body(i)),
                          .command = agent.command,
                          .state = state_of(agent),
                          .readings = agent.readings});
    }
    objects_.clear();
    for (int i = world_.robots(); i < world_.movers(); ++i)
      objects_.push_back(pose_of(world_.body(i)));
    recorder_.observe({.cycle = instant, .robots = records_, .objects = objects_});
  }

  std::uint64_t digest() const {
    Digest digest;
    for (int i = 0; i < world_.movers(); ++i) {
      const Body& body = world_.body(i);
      for (const double value : {body.x, body.y, body.cos, body.sin, body.vx, body.vy, body.spin}) {
        digest.add(value);
      }
      if (i < world_.robots()) digest.add(state_of(agents_[static_cast<std::size_t>(i)]));
    }
    return digest.value64();
  }

  const SimulationSetup& setup_;
  const Recorder& recorder_;
  Decider* decider_;  ///< null: the controller decides
  bool every_step_;   ///< whether the decider takes part in every sub-step
  bool stops_more_;   ///< whether `attend` has anything to do
  bool distorts_commands_;
  bool slips_;
  bool disturbs_;
  std::vector<Profile> profiles_;  ///< of the robots, if they differ
  Flavour flavour_;
  Arena arena_;
  World world_;
  Scorer scorer_;
  std::vector<Agent> agents_;
  std::vector<std::int64_t> next_events_;  ///< next event of each agent
  std::vector<Grip> grips_;                ///< of the robots; empty if none slips
  std::vector<NoiseStream> wheel_noises_;  ///< of the robots; empty without noise
  std::vector<Point> positions_;
  std::vector<Point> object_positions_;
  std::vector<int> due_;  ///< due robots, for a decider
  std::vector<RobotRecord> records_;
  std::vector<Pose> objects_;
};

}  // namespace

int engine_version_of(const Mission& mission, const Profile& profile) {
  const bool has_driver = profile.timing.driver_sub_steps != 0 ||
                          std::ranges::any_of(profile.ranges, [](const FieldRange& range) {
                            return range.field == "timing.driver";
                          });
  if (has_driver && mission.robot.ground.reading == GroundSensor::Reading::Vote)
    return kVoteVersion;
  if (has_own_lights(mission.robot)) return kLightVersion;
  if (can_hide(mission.arena, mission.robot)) return kSightVersion;
  const bool meets_obstacles = profile.contacts == ContactModel::Exact &&
                               !mission.arena.obstacles.empty() &&
                               has_squares_alone(mission.arena, mission.robot);
  return meets_obstacles ? kObstaclesVersion : kEngineVersion;
}

Measured simulate(const SimulationSetup& setup, const Recorder& recorder, Decider* decider) {
  SWARMSMITH_ASSERT(!setup.instance.starts.empty(), "an instance places at least one robot");
  return Run(setup, recorder, decider).run();
}

}  // namespace swarmsmith
