#include "robot/runtime/roll_call.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/assert.h"
#include "robot/runtime/robot_kind.h"
#include "robot/transport/messages.h"
#include "sim/files/robot_file.h"

namespace swarmsmith {
namespace {

constexpr Duration kEchoPatience = std::chrono::milliseconds(250);
// Treads stop after 300 ms without one (docs/robot-runtime.md, "When it stops").
constexpr Duration kAliveEvery = std::chrono::milliseconds(100);
constexpr Duration kStopEvery = std::chrono::milliseconds(200);
constexpr Duration kArmPatience = std::chrono::seconds(1);
constexpr Duration kRunningPatience = std::chrono::milliseconds(500);
constexpr Duration kStopPatience = std::chrono::seconds(2);
constexpr Duration kEndPatience = std::chrono::seconds(2);

bool is_on(Phase phase) {
  return phase == Phase::Armed || phase == Phase::Running;
}

/// Machine, flavour, robot, turn clock, seed and version must be the same on all robots; the random
/// streams must differ.
/// Adds a complaint such as "rvr2: has the seed 3, and rvr1 has 1".
void compare(const RolledRobot& robot, const RolledRobot& first, const char* what,
             const std::string& its, const std::string& of_first,
             std::vector<std::string>& complaints) {
  if (its == of_first) return;
  complaints.push_back(
      fmt::format("{}: {} {}, and {} has {}", robot.name, what, its, first.name, of_first));
}

/// Compares a robot's kind with the wanted one, or with that of the first robot.
void compare_kinds(const RolledRobot& robot, const RolledRobot& first, const Robot* wanted,
                   std::vector<std::string>& complaints) {
  const auto kind = parse_own_robot(robot.state->own_robot);
  const auto of_first = parse_own_robot(first.state->own_robot);
  if (!kind) {
    complaints.push_back(
        robot.name +
        ": its state has an `own_robot` that this program cannot read: " + kind.error().message);
  } else if (wanted != nullptr) {
    if (const auto why = other_robot("the run", *wanted, *kind))
      complaints.push_back(robot.name + ": " + *why);
  } else if (of_first && other_robot("", *kind, *of_first)) {
    compare(robot, first, "drives the robot", kind->name,
            of_first->name == kind->name ? "one of other values" : of_first->name, complaints);
  }
}

}  // namespace

RollCall::RollCall(const std::vector<std::string>& robots, std::string id)
    : id_(std::move(id)), answered_(robots.size(), true) {
  for (const std::string& name : robots)
    robots_.push_back({.name = name, .state = {}, .heard = {}});
}

void RollCall::hear(std::size_t robot, const NodeState& state, const Now& now) {
  SWARMSMITH_ASSERT(robot < robots_.size(), "only robots of the roll are heard");
  RolledRobot& rolled = robots_[robot];
  // Also states that answer no echo count: they are the robot's sign of life.
  rolled.state = state;
  rolled.heard = now.clock;
  if (answered_[robot] || state.order != fmt::format("{}-echo{}", id_, round_)) return;
  answered_[robot] = true;
  const double took_s = seconds_of(now.clock - sent_.clock);
  // The clock of the robot was read at an unknown instant between sending and arrival. The middle
  // is wrong by at most half of this time (Cristian 1989), so the fastest of the ten echoes is the
  // best.
  if (rolled.echoes == 0 || took_s < rolled.echo_s) {
    rolled.echo_s = took_s;
    rolled.offset_s = state.unix_s - (sent_.unix_s + took_s / 2);
  }
  ++rolled.echoes;
}

std::optional<Order> RollCall::tick(const Now& now) {
  if (is_complete()) return std::nullopt;
  const bool all = std::ranges::all_of(answered_, [](bool answered) { return answered; });
  // One round at a time, because an answer is recognised by the last order in the state. A lost
  // echo does not count: more rounds follow until each robot has answered ten.
  if (!all && now.clock - sent_.clock < kEchoPatience) return std::nullopt;
  ++round_;
  sent_ = now;
  answered_.assign(robots_.size(), false);
  Order echo;
  echo.kind = Order::Kind::Echo;
  echo.id = fmt::format("{}-echo{}", id_, round_);
  echo.sent_unix_s = now.unix_s;
  echo.valid_s = 10;  // long, so that a clock that is far off can be measured, too
  return echo;
}

bool RollCall::is_complete() const {
  return std::ranges::all_of(robots_,
                             [](const RolledRobot& robot) { return robot.echoes >= kEchoes; });
}

std::vector<std::string> RollCall::complaints(TimePoint now, const Robot* kind) const {
  std::vector<std::string> complaints;
  const RolledRobot* first = nullptr;
  for (const RolledRobot& robot : robots_) {
    // Without a present state nothing else about this robot can be checked.
    if (!robot.state || now - robot.heard > kMostSilence) {
      complaints.push_back(robot.name +
                           ": does not answer; is its node running, and on this network?");
      continue;
    }
    const NodeState& state = *robot.state;
    if (robot.echoes == 0)
      complaints.push_back(robot.name +
                           ": does not answer orders, so its clock is not known; do "
                           "they reach its node?");
    // Orders name robots: this node would ignore those for `robot.name`.
    if (state.robot != robot.name)
      complaints.push_back(robot.name + ": its node calls itself " + state.robot);
    if (is_on(state.phase))
      complaints.push_back(robot.name + ": the run " + state.run + " is in progress");
    for (const std::string& reason : state.not_ready)
      complaints.push_back(robot.name + ": " + reason);
    // Each robot begins by its own wall clock (docs/robot-runtime.md, "Network and clocks").
    if (std::fabs(robot.offset_s) > kMostOffset_s) {
      complaints.push_back(
          fmt::format("{}: its clock is {:.0f} ms {} this computer's, more than {:.0f} ms: "
                      "synchronise them (chrony)",
                      robot.name, 1000 * std::fabs(robot.offset_s),
                      robot.offset_s > 0 ? "ahead of" : "behind", 1000 * kMostOffset_s));
    }
    // Compared with the first robot that answers. If nothing is reported, all are equal.
    if (first == nullptr) first = &robot;
    const NodeState& other = *first->state;
    compare(robot, *first, "has the machine", state.machine_digest, other.machine_digest,
            complaints);
    compare(robot, *first, "has the flavour", state.flavour, other.flavour, complaints);
    compare_kinds(robot, *first, kind, complaints);
    compare(robot, *first, "has the turn clock", state.turn_clock, other.turn_clock, complaints);
    // The nodes' own seeds; if the order has a seed, it replaces them.
    compare(robot, *first, "has the seed", std::to_string(state.seed), std::to_string(other.seed),
            complaints);
    compare(robot, *first, "has the version", state.version, other.version, complaints);
    for (const RolledRobot& before : robots_) {
      if (&before == &robot) break;
      // With one stream, two robots would draw the same random numbers.
      if (before.state && before.state->robot_index == state.robot_index) {
        complaints.push_back(
            fmt::format("{}: has the random stream {}, as {}: give it another "
                        "--index",
                        robot.name, state.robot_index, before.name));
      }
    }
  }
  return complaints;
}

RunStarter::RunStarter(Settings settings, const std::vector<std::string>& robots, std::string id,
                       const Now& now)
    : settings_(std::move(settings)),
      roll_(robots, id),
      id_(std::move(id)),
      called_(now.clock),
      names_(robots) {
  SWARMSMITH_ASSERT(!names_.empty(), "an order without names would be for all robots");
}

void RunStarter::hear(std::size_t robot, const NodeState& state, const Now& now) {
  roll_.hear(robot, state, now);
}

Order RunStarter::order(Order::Kind kind, const Now& now) {
  Order made;
  made.kind = kind;
  made.id = fmt::format("{}-{}", id_, ++orders_);
  made.run = settings_.run;
  // Always by name: other robots may use the same network for another run.
  made.robots = names_;
  made.sent_unix_s = now.unix_s;
  return made;
}

bool RunStarter::is_in_run(const RolledRobot& robot) const {
  // A state of an earlier run says nothing about this one.
  return robot.state && robot.state->run == settings_.run && is_on(robot.state->phase);
}

bool RunStarter::is_over_for(const RolledRobot& robot) const {
  // The log belongs to the run: a node whose rows are missing fails only when it closes its log.
  return has_left(robot) && !robot.state->log_open;
}

bool RunStarter::has_left(const RolledRobot& robot) const {
  return robot.state && robot.state->run == settings_.run && !is_on(robot.state->phase) &&
         robot.state->phase != Phase::Idle && robot.state->phase != Phase::Ready;
}

void RunStarter::give_up(std::string why, const Now& now) {
  SWARMSMITH_ASSERT(stage_ != Stage::Calling && stage_ != Stage::Over,
                    "only what was ordered is stopped");
  // Each complaint makes the run INVALID (`verdict`), also if the robots do not notice the problem.
  complaints_.push_back(std::move(why));
  if (stage_ == Stage::Stopping) return;
  stage_ = Stage::Stopping;
  stopping_ = now.clock;
  // So that the order to stop is sent at once, not only after kStopEvery.
  alive_ = {};
}

void RunStarter::interrupt(const Now& now) {
  // No robot has an order yet, so there is none to stop.
  if (stage_ == Stage::Calling) {
    complaints_.emplace_back("interrupted before the start");
    stage_ = Stage::Over;
  } else if (stage_ == Stage::Ordered || stage_ == Stage::Watching) {
    give_up("interrupted: stopping all robots", now);
  }
}

std::vector<Order> RunStarter::tick(const Now& now) {
  std::vector<Order> orders;
  switch (stage_) {
    case Stage::Calling: {
      if (auto echo = roll_.tick(now)) orders.push_back(std::move(*echo));
      const bool late = now.clock - called_ > duration_of(settings_.patience_s);
      if (!roll_.is_complete() && !late) break;
      complaints_ = roll_.complaints(now.clock, &settings_.kind);
      if (!complaints_.empty()) {
        if (late) stage_ = Stage::Over;  // until then robots may become ready
        break;
      }
      Order start = order(Order::Kind::Start, now);
      // By the operator's wall clock. The robots' clocks were compared with it just before.
      start.at_unix_s = now.unix_s + settings_.lead_s;
      start.seconds = settings_.seconds;
      start.seed = settings_.seed;
      start.own_robot = own_robot_text(settings_.kind);
      for (const RolledRobot& robot : roll_.robots()) {
        SWARMSMITH_ASSERT(robot.echoes > 0, "a run starts when all clocks are measured");
        // For the robots' logs: with it the tracker compares a log with the camera.
        start.clock_offsets_s[robot.name] = robot.offset_s;
      }
      // The operator's own limits of time follow its steady clock, too.
      start_ = {now.clock + duration_of(settings_.lead_s), start.at_unix_s};
      start_id_ = start.id;
      stage_ = Stage::Ordered;
      called_ = alive_ = now.clock;
      orders.push_back(std::move(start));
      break;
    }
    case Stage::Ordered:
    case Stage::Watching:
      watch(now);
      // Not while stopping: a robot that misses the order to stop then stops because of the
      // silence.
      if (stage_ != Stage::Stopping && stage_ != Stage::Over && now.clock - alive_ >= kAliveEvery) {
        alive_ = now.clock;
        orders.push_back(order(Order::Kind::Alive, now));
      }
      break;
    case Stage::Stopping:
      break;
    case Stage::Over:
      return orders;
  }
  if (stage_ != Stage::Stopping) return orders;
  // Also waits for open logs, so that the verdicts of robots that stopped are their last ones.
  const bool none = std::ranges::none_of(roll_.robots(), [this](const RolledRobot& robot) {
    return is_in_run(robot) || (has_left(robot) && !is_over_for(robot));
  });
  // Repeated, because an order may be lost. It has priority over the end, so at least one is sent.
  if (now.clock - alive_ >= kStopEvery) {
    alive_ = now.clock;
    orders.push_back(order(Order::Kind::Stop, now));
  } else if (none || now.clock - stopping_ > kStopPatience) {
    for (const RolledRobot& robot : roll_.robots()) {
      // The last state that was heard. The robot may have stopped, but its state does not say so.
      if (is_in_run(robot))
        complaints_.push_back(robot.name + ": did not confirm that it stopped; check the robot");
    }
    stage_ = Stage::Over;
  }
  return orders;
}

/// One robot that does not take part changes what the others meet, so the run is stopped for all
/// (docs/robot-runtime.md, "Start").
void RunStarter::watch(const Now& now) {
  for (const RolledRobot& robot : roll_.robots()) {
    // The roll call has no complaint about a robot only if that robot has answered.
    SWARMSMITH_ASSERT(robot.state, "a robot that was started has sent its state");
    // Signs of life do not replace the node's last order, so a refusal stays visible.
    if (robot.state->order == start_id_ && !robot.state->refused.empty())
      return give_up(robot.name + ": refuses the start: " + robot.state->refused, now);
    // A robot that has ended its run may be switched off.
    if (now.clock - robot.heard > kMostSilence && !is_over_for(robot))
      return give_up(robot.name + ": has sent nothing for 1 s", now);
    // Stopped or failed before its time was over.
    if (has_left(robot) && robot.state->phase != Phase::Ended) {
      const auto& reasons = robot.state->reasons;
      return give_up(fmt::format("{}: {}: {}", robot.name, name_of(robot.state->phase),
                                 reasons.empty() ? "no reason given" : reasons.front()),
                     now);
    }
  }
  const auto all = [this](auto what) { return std::ranges::all_of(roll_.robots(), what); };
  if (stage_ == Stage::Ordered) {
    // All must accept before the agreed instant: kArmPatience is shorter than the default `lead_s`,
    // so the others are stopped before they move.
    if (!all([this](const RolledRobot& robot) { return is_in_run(robot); })) {
      if (now.clock - called_ > kArmPatience) give_up("not all robots accepted the start", now);
      return;
    }
    stage_ = Stage::Watching;
  }
  if (!begun_ && now.clock > start_.clock + kRunningPatience) {
    for (const RolledRobot& robot : roll_.robots()) {
      if (robot.state->phase == Phase::Armed) {
        return give_up(robot.name + ": is not running 0.5 s after the start", now);
      }
    }
    begun_ = true;
  }
  if (all([this](const RolledRobot& robot) { return is_over_for(robot); })) {
    begun_ = true;
    stage_ = Stage::Over;
    // Each robot ends its run by its own clock; this is the time for its last state and its log.
  } else if (now.clock > start_.clock + duration_of(settings_.seconds) + kEndPatience) {
    give_up("not all robots ended the run", now);
  }
}

RunVerdict RunStarter::verdict() const {
  // The score is one number for the whole swarm, so the worst robot decides.
  RunVerdict worst = complaints_.empty() ? RunVerdict::Valid : RunVerdict::Invalid;
  for (const RolledRobot& robot : roll_.robots())
    worst = std::max(worst, is_over_for(robot) ? robot.state->verdict : RunVerdict::Invalid);
  return worst;
}

}  // namespace swarmsmith
