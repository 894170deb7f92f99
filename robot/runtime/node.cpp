#include "robot/runtime/node.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/assert.h"
#include "base/hash.h"
#include "base/plain_text.h"
#include "robot/runtime/robot_kind.h"
#include "sim/control/flavour_file.h"
#include "sim/control/used_senses.h"
#include "sim/engine/fitting.h"
#include "sim/files/robot_file.h"

namespace swarmsmith {
namespace {

constexpr Rgb kRed = {255, 0, 0};
/// Limits of docs/robot-runtime.md, "When it stops".
/// Fractions of a run's cycles. Skipped cycles above them make the run degraded or invalid; held
/// cycles above kInvalid end it.
constexpr double kDegraded = 0.01;
constexpr double kInvalid = 0.05;
constexpr double kLatestStart_s = 60;  ///< the longest time until an ordered start

double milliseconds_of(Duration duration) {
  return std::chrono::duration<double, std::milli>(duration).count();
}

double clock_s(TimePoint time) {
  return seconds_of(time.time_since_epoch());
}

/// The instant of the steady clock for a time of the wall clock.
/// Used once, when an order arrives: from then on the run follows the steady clock, and a step of
/// the wall clock moves neither its start nor its cycles.
TimePoint clock_at(double unix_s, const Now& now) {
  return now.clock + Duration(std::llround(1e9 * (unix_s - now.unix_s)));
}

/// Both treads at 0. Red LEDs show that the node stopped the robot because of a problem.
Command standing(bool red) {
  Command command;
  if (red) command.leds.fill(kRed);
  return command;
}

/// Machine, flavour and turn clock decide what a robot does with its readings. Two flavours may
/// have the same name, so the text of one that is not built in counts, too. A roll call compares
/// these digests.
std::string digest_of(const std::string& machine, const Flavour& flavour) {
  Digest digest;
  digest.add(machine);
  digest.add(flavour.name);
  if (const std::string own = own_flavour_text(flavour); !own.empty()) digest.add(own);
  digest.add(name_of(flavour.exploration.turn_clock));
  return digest.hex();
}

/// Seconds since the start at cycle k of a simulated world with a steady clock, computed as in the
/// engine, in steps of 10 ms.
/// k * 0.1 has other bits for some k, and a machine that turns by seconds would decide differently.
double counted_time_s(std::int64_t cycle) {
  constexpr double kStep_s = 0.01;
  constexpr std::int64_t kSteps = 10;
  return kStep_s * static_cast<double>(kSteps * cycle);
}

}  // namespace

std::optional<Command> within_limits(const Command& command, double max_mps) {
  SWARMSMITH_ASSERT(max_mps >= 0, "a limit of speeds is not negative");
  // First, because std::clamp returns a NaN unchanged. Speeds are limited by ROS facts, 3.8.
  if (!(std::isfinite(command.left_mps) && std::isfinite(command.right_mps))) return std::nullopt;
  Command limited = command;
  limited.left_mps = std::clamp(command.left_mps, -max_mps, max_mps);
  limited.right_mps = std::clamp(command.right_mps, -max_mps, max_mps);
  return limited;
}

RobotNode::RobotNode(NodeSettings settings, const Controller& controller, const Flavour& flavour)
    : settings_(std::move(settings)),
      controller_(&controller),
      flavour_(&flavour),
      fitted_(fitted(flavour, settings_.kind)),
      own_robot_(own_robot_text(settings_.kind)),
      machine_text_(print_controller(controller, flavour)),
      machine_digest_(digest_of(machine_text_, flavour)),
      needed_(feeds_of(senses_used_by(controller, flavour))),
      feeds_(settings_.feeds),
      door_(settings_.robot),
      driver_({.hold = settings_.driver_hold, .give_up = settings_.give_up}),
      seed_(settings_.seed) {
  SWARMSMITH_ASSERT(settings_.period > Duration::zero() && settings_.max_mps >= 0,
                    "options were checked where they were read");
  for (const Feed feed : kAllFeeds)
    needed_[index_of(feed)] |= settings_.also_needed[index_of(feed)];
}

std::optional<RobotNode::Silence> RobotNode::silence(TimePoint now,
                                                     const PerFeed<Duration>& limits) const {
  std::optional<Silence> worst;
  for (const Feed feed : kAllFeeds) {
    if (!needed_[index_of(feed)]) continue;
    // A sensor without any usable message is older than every limit.
    const Duration age = feeds_.age(feed, now).value_or(Duration::max());
    if (age > limits[index_of(feed)] && (!worst || age > worst->age)) worst = {feed, age};
  }
  return worst;
}

std::string RobotNode::told(const Silence& silence) const {
  const std::string name(name_of(silence.feed));
  const std::string& trouble = feeds_.trouble(silence.feed);
  const std::string why = trouble.empty() ? "" : " (" + trouble + ")";
  if (silence.age == Duration::max()) return name + ": no message yet" + why;
  return fmt::format("{}: silent for {:.2f} s{}", name, seconds_of(silence.age), why);
}

std::vector<std::string> RobotNode::not_ready(TimePoint now) const {
  std::vector<std::string> reasons;
  // A kill lasts until a person restarts the node (decision 22).
  if (killed_) reasons.emplace_back("killed by order: restart the node");
  for (const Feed feed : kAllFeeds) {
    if (!needed_[index_of(feed)]) continue;
    const Duration age = feeds_.age(feed, now).value_or(Duration::max());
    if (age > settings_.hold[index_of(feed)]) reasons.push_back(told({feed, age}));
  }
  for (std::string& reason : driver_.not_ready(now))
    reasons.push_back(std::move(reason));
  // A robot without a battery sensor can start: an unknown charge is not a low one.
  if (battery_ && *battery_ < settings_.least_battery) {
    reasons.push_back(fmt::format("battery: {:.0f} %, at least {:.0f} % are needed",
                                  100 * *battery_, 100 * settings_.least_battery));
  }
  if (!log_trouble_.empty()) reasons.push_back("log: " + log_trouble_);
  return reasons;
}

void RobotNode::hear(const BatteryMessage& message) {
  // A charge that is not a number replaces an earlier number, so that an old value does not count.
  battery_.reset();
  if (std::isfinite(message.charge)) battery_ = message.charge;
}

void RobotNode::hear(const Order& order, const Now& now) {
  if (!door_.is_for_this_robot(order)) return;
  // It comes often, and does not replace the last real order.
  if (order.kind == Order::Kind::Alive) return hear_alive(order, now);
  auto refusal = door_.refusal(order, now.unix_s);
  // The state repeats this id. An operator recognises by it the answer to its echo or start,
  // whether the order was obeyed or refused.
  order_ = order.id;
  refused_.clear();
  if (refusal) {
    refused_ = std::move(*refusal);
  } else {
    obey(order, now);
  }
}

/// An old message, delayed or replayed, does not count. Its age is measured with the steady clock
/// here, because a wall clock may be stepped during a run without any effect on the run or the
/// operator.
void RobotNode::hear_alive(const Order& order, const Now& now) {
  constexpr double kDrift = 1e-3;  // drift of the two clocks
  if (!is_on() || order.run != run_) return;
  // The reference is the order that was delayed least so far. The time of a later order is compared
  // with the reference plus the elapsed time here, so the wall clock of this robot plays no part.
  const double since_s = seconds_of(now.clock - operator_clock_.clock);
  const double ahead_s = order.sent_unix_s - (operator_clock_.unix_s + since_s);
  operator_behind_s_ = 0;
  // It does not count as a sign of life, and the treads stop as if the operator were silent.
  if (ahead_s < -order.valid_s - kDrift * since_s) {
    operator_behind_s_ = -ahead_s;
    return;
  }
  operator_heard_ = now.clock;
  // The reference was delayed by at most `valid_s`. So an order that is dated later than this shows
  // that the operator's clock was stepped forward, which does not affect the run.
  if (ahead_s > order.valid_s + kDrift * since_s) {
    new_step_ = fmt::format("the operator's clock was stepped by {:+.2f} s", ahead_s);
    clock_steps_.push_back(fmt::format("{} at {:.1f} s", new_step_, time_s(now.clock)));
  }
  // Its delay was shorter than that of the reference, or the operator's clock was stepped forward.
  if (ahead_s > 0) operator_clock_ = {now.clock, order.sent_unix_s};
}

/// The run follows the steady clock. A step of the wall clock is recorded in the log.
void RobotNode::look_at_clock(const Now& now) {
  constexpr double kStep_s = 0.1;
  // Both clocks were read for the same instant, so their difference changes by drift or by a step.
  const double ahead_s = now.unix_s - clock_s(now.clock);
  const double step_s = ahead_s - std::exchange(wall_ahead_s_, ahead_s);
  if (std::fabs(step_s) < kStep_s) return;
  new_step_ = fmt::format("this computer's clock was stepped by {:+.2f} s", step_s);
  clock_steps_.push_back(fmt::format("{} at {:.1f} s", new_step_, time_s(now.clock)));
}

double RobotNode::time_s(TimePoint at) const {
  SWARMSMITH_ASSERT(clock_, "only a run has a time");
  return std::max(0.0, seconds_of(at - clock_->start()));
}

void RobotNode::obey(const Order& order, const Now& now) {
  switch (order.kind) {
    case Order::Kind::Start:
      arm(order, now);
      return;
    case Order::Kind::Stop:
      if (!is_on()) {
        refused_ = "no run is in progress";
        // A delayed stop of an earlier run must not end this one.
      } else if (!order.run.empty() && order.run != run_) {
        refused_ = "the run " + run_ + " is in progress, not " + order.run;
      } else {
        stop("by order");
      }
      return;
    case Order::Kind::Kill:
      // Also if no run is active: from now on the node commands 0 and refuses every start.
      killed_ = true;
      fail("killed by order");
      return;
    case Order::Kind::Alive:
    case Order::Kind::Echo:
      return;
  }
}

/// The node checks everything itself, although `start` has checked it before: an order may come
/// from another program, and the robot's state may have changed since the roll call.
void RobotNode::arm(const Order& order, const Now& now) {
  if (is_on()) {
    refused_ = "the run " + run_ + " is in progress";
    return;
  }
  const auto kind = parse_own_robot(order.own_robot);
  if (!kind) {
    refused_ = "the order's `own_robot` is not a robot that this program can read: " +
               kind.error().message;
    return;
  }
  if (auto why = other_robot("the order", *kind, settings_.kind)) {
    refused_ = std::move(*why);
    return;
  }
  // A start that is recorded and sent again must not move the robot (ROS facts, 3.7). The names of
  // logs also need runs with different names.
  if (runs_.contains(order.run)) {
    refused_ =
        "the robot has already had an order for run " + order.run + "; a new run needs a new name";
    return;
  }
  for (const std::string& reason : not_ready(now.clock))
    refused_ += (refused_.empty() ? "" : "; ") + reason;
  if (!refused_.empty()) return;
  // By the wall clocks, which the operator has compared (docs/robot-runtime.md, "Network and
  // clocks"). A start that is not in the future cannot be at the same instant on all robots.
  const double ahead_s = order.at_unix_s - now.unix_s;
  // Written so that NaN is refused.
  if (!(ahead_s > 0 && ahead_s <= kLatestStart_s)) {
    refused_ =
        fmt::format("the start is {:.1f} s {}; it must be more than 0 and at most {:.0f} s ahead",
                    std::fabs(ahead_s), ahead_s > 0 ? "ahead" : "ago", kLatestStart_s);
    return;
  }
  SWARMSMITH_ASSERT(!is_on() && !killed_, "no run begins in another, nor after a kill");
  const auto cycles =
      static_cast<std::int64_t>(std::llround(order.seconds / seconds_of(settings_.period)));
  if (cycles < 1) {  // it would have no last cycle, and so no end
    refused_ = fmt::format("a run of {} s is shorter than a cycle of {} s", order.seconds,
                           seconds_of(settings_.period));
    return;
  }
  const TimePoint start = clock_at(order.at_unix_s, now);
  begin(order.run, order.seed.value_or(settings_.seed), cycles, {start, order.at_unix_s});
  phase_ = Phase::Armed;
  seconds_ = order.seconds;
  // The start counts as the operator's first sign of life, and as the first reference of its clock.
  operator_heard_ = now.clock;
  operator_clock_ = {now.clock, order.sent_unix_s};
  wall_ahead_s_ = now.unix_s - clock_s(now.clock);
  if (const auto offset = order.clock_offsets_s.find(settings_.robot);
      offset != order.clock_offsets_s.end())
    clock_offset_s_ = offset->second;
}

/// `start` is the time when the run begins.
void RobotNode::begin(std::string run, std::int64_t seed, std::int64_t cycles, const Now& start) {
  run_ = std::move(run);
  // From now on the name is used up, also if the log cannot be opened (`disarm`).
  runs_.insert(run_);
  seed_ = seed;
  seconds_ = 0;
  start_unix_s_ = start.unix_s;
  clock_offset_s_.reset();
  clock_.emplace(start.clock, settings_.period, cycles);
  // The simulator has the same stream for a seed and an index; that is why a run in lock-step can
  // have the same bits as `evaluate` (docs/robot-messages.md, "Lock-step").
  control_.emplace(*controller_, fitted_, control_stream(seed, settings_.robot_index));
  cycle_ = stepped_ = held_ = skipped_ = cut_ = 0;
  held_for_ = {};
  by_driver_ = by_operator_ = {};
  driver_failed_ = false;
  clock_steps_.clear();
  new_step_.clear();
  operator_behind_s_ = 0;
  longest_silence_ = {};
  broken_.clear();
  log_lost_ = false;
  phase_ = Phase::Running;
  // Listeners and the reporting driver of this moment are those of the run: later changes are
  // troubles or doubts.
  driver_.begin(start.clock);
  judge();
}

TimePoint RobotNode::next_tick(TimePoint now) const {
  // Absolute deadlines do not drift (ROS facts, 3.4).
  if (phase_ == Phase::Running && !lock_step_) return clock_->next();
  const TimePoint regular = std::max(now, last_tick_ + settings_.period);
  // Outside a run the node ticks once per period: this updates its phase and repeats its zeros. An
  // armed node also wakes at the agreed instant.
  return phase_ == Phase::Armed ? std::min(regular, clock_->start()) : regular;
}

Decision RobotNode::tick(const Now& now) {
  Decision decision = decide(now);
  if (decision.command) {
    // In real time, speeds other than 0 reach the transport only from here.
    check_treads(*decision.command);
    driver_.commanded(now.clock, decision.command->left_mps, decision.command->right_mps);
  }
  if (decision.row && !new_step_.empty()) {
    std::string& event = decision.row->event;
    event += (event.empty() ? "" : "; ") + std::exchange(new_step_, {});
  }
  return decision;
}

/// Checks the command to the treads, whatever its origin. NaN fails the check, too.
void RobotNode::check_treads(const Command& command) const {
  const auto is_within = [this](double mps) { return std::fabs(mps) <= settings_.max_mps; };
  // A failed assertion ends the process; then the driver stops the treads after 300 ms
  // (docs/robot-runtime.md, "Drivers").
  SWARMSMITH_ASSERT(is_within(command.left_mps) && is_within(command.right_mps),
                    "no tread is commanded beyond its limit");
  SWARMSMITH_ASSERT(phase_ == Phase::Running || (command.left_mps == 0 && command.right_mps == 0),
                    "treads move only in a run");
}

std::string RobotNode::silence_of_operator(const Now& now) const {
  const double silent_s = seconds_of(now.clock - operator_heard_);
  if (operator_behind_s_ == 0)
    return fmt::format("no message from the operator for {:.2f} s", silent_s);
  return fmt::format(
      "the operator's orders have had times {:.2f} s too early for {:.2f} s: its clock was set "
      "back, or the network delays them",
      operator_behind_s_, silent_s);
}

Decision RobotNode::decide(const Now& now) {
  last_tick_ = now.clock;
  if (phase_ == Phase::Idle || phase_ == Phase::Ready) {
    phase_ = not_ready(now.clock).empty() ? Phase::Ready : Phase::Idle;
    return {};  // the robot may be carried or driven to its start position
  }
  SWARMSMITH_ASSERT(!is_on() || (clock_ && control_), "a run has a clock and a controller");
  // Also while the node waits for the agreed instant: it must not begin without its operator.
  if (is_on() && settings_.operator_gone > Duration::zero() &&
      now.clock - operator_heard_ > settings_.operator_gone) {
    fail(silence_of_operator(now));
  }
  if (is_on()) look_at_clock(now);
  if (phase_ == Phase::Armed && now.clock >= clock_->start()) phase_ = Phase::Running;
  if (phase_ == Phase::Running) {
    const ControlClock::Beat beat = clock_->beat(now.clock);
    // Called early. The command of the last cycle is still valid.
    if (beat.cycle == 0) return {};
    return run_cycle(beat, now);
  }
  // Each way out sends a zero (ROS facts, 3.8). It is repeated at each tick, because messages may
  // be lost (ROS facts, 2.6).
  return {.command = standing(phase_ == Phase::Failed), .state = 0, .row = {}};
}

Decision RobotNode::run_cycle(const ControlClock::Beat& beat, const Now& now) {
  SWARMSMITH_ASSERT(beat.cycle > cycle_ && beat.cycle <= clock_->cycles(),
                    "cycles come in order, each once, and the last one ends the run");
  // Skipped cycles are not made up for: probabilities are per cycle, so two steps in one period
  // would be another machine (decision 22).
  skipped_ += beat.skipped;
  // The last cycle is due when the run's time is over: a command in it would be executed after the
  // end.
  if (beat.cycle == clock_->cycles()) {
    end(Phase::Ended);
    return {.command = standing(false), .state = 0, .row = {}};
  }
  // The gravest problem comes first: it decides whether the run ends, and which reason people read.
  // The order is: a sensor that is lost, the driver, a sensor that is silent, a silent operator.
  // (An operator who is gone has ended the run in `decide`.)
  PerFeed<Duration> give_up;
  give_up.fill(settings_.give_up);
  if (const auto lost = silence(now.clock, give_up)) {
    // Before the run fails, so that its last row of the log has the reason.
    Decision decision = hold(beat.cycle, beat.late, now, told(*lost));
    fail(told(*lost));
    return decision;
  }
  // Checked in each cycle, also in cycles that are held for a sensor: the watch measures how long
  // the treads did not obey.
  if (const auto trouble = driver_.trouble(now.clock)) {
    const std::string why =
        fmt::format("driver: {} (for {:.2f} s, since {:.1f} s)", trouble->what,
                    seconds_of(now.clock - trouble->since), time_s(trouble->since));
    if (trouble->ends) {
      driver_failed_ = true;
      Decision decision = hold(beat.cycle, beat.late, now, why);
      fail(why);
      return decision;
    }
    count(by_driver_, "driver: " + trouble->what, trouble->since, now);
    return hold_and_count(beat, now, why);
  }
  // ROS facts, 3.6. The machine does not see this cycle (decision 22): it would take an old reading
  // for the present one.
  if (const auto silent = silence(now.clock, settings_.hold)) {
    ++held_for_[index_of(silent->feed)];
    Duration& longest = longest_silence_[index_of(silent->feed)];
    longest = std::max(longest, silent->age);
    return hold_and_count(beat, now, told(*silent));
  }
  if (settings_.operator_gone > Duration::zero() &&
      now.clock - operator_heard_ > settings_.operator_hold) {
    count(by_operator_, "the operator was silent", operator_heard_, now);
    return hold_and_count(beat, now, silence_of_operator(now));
  }
  PerFeed<Duration> late;
  late.fill(settings_.late);
  // The machine gets the last reading; only the log shows that it was old.
  const auto old = silence(now.clock, late);
  sensed_ = feeds_.sensed();
  // The real time, not k periods, so that turns by seconds have the right length after a skipped
  // cycle.
  sensed_.time_s = seconds_of(now.clock - clock_->start());
  Decision decision = step(beat.cycle, beat.late, now);
  if (old && decision.row && decision.row->event.empty()) decision.row->event = told(*old);
  return decision;
}

void RobotNode::count(Standing& standing, const std::string& what, TimePoint since,
                      const Now& now) {
  ++standing.cycles;
  // The reason names the longest one, because there is one line for all of them.
  if (now.clock - since <= standing.longest) return;
  standing.what = what;
  standing.longest = now.clock - since;
  standing.at_s = time_s(since);
}

/// Counts a cycle without a step; too many of them end the run.
Decision RobotNode::hold_and_count(const ControlClock::Beat& beat, const Now& now,
                                   const std::string& why) {
  ++held_;
  SWARMSMITH_ASSERT(held_ <= beat.cycle, "a cycle is held once");
  Decision decision = hold(beat.cycle, beat.late, now, why);
  // Of the whole run's cycles, so the limit is the same at its beginning and at its end.
  if (static_cast<double>(held_) > kInvalid * static_cast<double>(clock_->cycles()))
    fail(fmt::format("the treads stood in {} of {} cycles; {}", held_, clock_->cycles(), why));
  return decision;
}

Decision RobotNode::step(std::int64_t cycle, Duration late, const Now& now) {
  SWARMSMITH_ASSERT(control_ && cycle > cycle_, "a controller is stepped once in a cycle");
  cycle_ = cycle;
  // `replay` repeats exactly these calls, from the log's rows.
  SensedSenses senses(sensed_);
  const Command wanted = control_->step(senses);
  const auto limited = within_limits(wanted, settings_.max_mps);
  ++stepped_;
  SWARMSMITH_ASSERT(stepped_ + held_ + skipped_ <= cycle, "a cycle is stepped, held or skipped");
  // The row is made after the step: state and number of random numbers are those that it left.
  Decision decision{.command = limited.value_or(standing(true)),
                    .state = control_->state(),
                    .row = row_of(cycle, late, now)};
  // The log has the speeds that are sent, not those that the controller wanted.
  decision.row->command = *decision.command;
  if (!limited) {
    decision.row->event = "the controller's speeds are not finite numbers";
    fail(decision.row->event);
  } else if (limited->left_mps != wanted.left_mps || limited->right_mps != wanted.right_mps) {
    // The robot does not do what the machine commands, so the run is DEGRADED (`judge`).
    ++cut_;
    decision.row->event =
        fmt::format("speeds cut from {} and {} m/s", wanted.left_mps, wanted.right_mps);
  }
  judge();
  return decision;
}

Decision RobotNode::hold(std::int64_t cycle, Duration late, const Now& now, std::string why) {
  cycle_ = cycle;
  // For the log only: the controller is not stepped, so its state and random numbers stay.
  sensed_ = feeds_.sensed();
  sensed_.time_s = seconds_of(now.clock - clock_->start());
  Decision decision{
      .command = standing(true), .state = control_->state(), .row = row_of(cycle, late, now)};
  decision.row->act = Act::Hold;
  decision.row->command = *decision.command;
  decision.row->event = std::move(why);
  judge();
  return decision;
}

LogRow RobotNode::row_of(std::int64_t cycle, Duration late, const Now& now) const {
  SWARMSMITH_ASSERT(control_ && cycle >= 1, "rows are those of a run's cycles, from 1");
  LogRow row;
  row.cycle = cycle;
  row.clock_s = clock_s(now.clock);
  row.late_ms = milliseconds_of(late);
  row.state = control_->state();
  row.sensed = sensed_;
  row.ground_as_sent = feeds_.ground_as_sent();
  row.drawn = control_->drawn();
  for (const Feed feed : kAllFeeds) {
    if (const auto age = feeds_.age(feed, now.clock))
      row.age_ms[index_of(feed)] = milliseconds_of(*age);
    row.stamp_ms[index_of(feed)] = feeds_.stamp_ms(feed);
  }
  return row;
}

Expected<Decision> RobotNode::answer(const SensesMessage& senses, const Now& now) {
  lock_step_ = true;
  if (senses.cycle == 0) {
    if (phase_ == Phase::Running) end(Phase::Ended);
    return Decision{};
  }
  if (senses.cycle == 1) {
    if (phase_ == Phase::Running) end(Phase::Ended);
    begin(fmt::format("{}-seed{}", settings_.lock_step_run, senses.seed), senses.seed, 0, now);
    // A lost or repeated cycle makes another run than the simulator's; the score alone does not
    // always show it (ROS facts, 3.9).
  } else if (phase_ != Phase::Running || senses.cycle != cycle_ + 1 || senses.seed != seed_) {
    std::string wrong = phase_ == Phase::Running
                            ? fmt::format("cycle {} of seed {} came after cycle {} of seed {}",
                                          senses.cycle, senses.seed, cycle_, seed_)
                            : fmt::format("cycle {} of seed {} came, but no run is in progress",
                                          senses.cycle, senses.seed);
    fail(wrong);
    return bad_input(std::move(wrong));
  }
  // The conversion of NaN to an integer below is undefined; clamp does not change a NaN.
  if (!std::ranges::all_of(senses.color, [](double value) { return std::isfinite(value); })) {
    std::string wrong = fmt::format("the colour of cycle {} is not a number", senses.cycle);
    fail(wrong);
    return bad_input(std::move(wrong));
  }
  sensed_.time_s = senses.time_s;
  sensed_.proximity_m = senses.ranges_m;
  sensed_.light_lux = senses.light_lux;
  const auto channel = [&senses](std::size_t i) {
    return static_cast<std::uint8_t>(std::clamp(senses.color[i], 0.0, 255.0));
  };
  sensed_.ground = {channel(0), channel(1), channel(2)};
  sensed_.neighbours.clear();
  for (const SeenRobot& robot : senses.neighbours)
    sensed_.neighbours.push_back({robot.distance_m, robot.direction_x, robot.direction_y});
  Decision decision = step(senses.cycle, {}, now);
  if (decision.row)
    decision.row->ground_as_sent = {senses.color[0], senses.color[1], senses.color[2]};
  return decision;
}

void RobotNode::begin_counted(const Now& now) {
  lock_step_ = true;
  begin(fmt::format("{}-seed{}", settings_.lock_step_run, settings_.seed), settings_.seed, 0, now);
}

Decision RobotNode::step_counted(const Now& now) {
  SWARMSMITH_ASSERT(control_, "begin_counted comes first");
  sensed_ = feeds_.sensed();
  // The world's time: in lock-step a cycle may take any time here.
  sensed_.time_s = counted_time_s(cycle_ + 1);
  return step(cycle_ + 1, {}, now);
}

void RobotNode::end(Phase phase) {
  SWARMSMITH_ASSERT(phase == Phase::Ended || phase == Phase::Stopped || phase == Phase::Failed,
                    "after its end a run is not on");
  phase_ = phase;
  driver_.end();
  judge();
}

void RobotNode::stop(const std::string& why) {
  if (!is_on()) return;
  broken_ = lock_step_ || cycle_ == 0
                ? "stopped " + why
                : fmt::format("stopped {} after {:.1f} s of {:.1f} s", why,
                              seconds_of(settings_.period) * static_cast<double>(cycle_), seconds_);
  end(Phase::Stopped);
}

void RobotNode::fail(const std::string& why) {
  // The first problem is the cause; later ones are often its consequences.
  if (broken_.empty()) broken_ = why;
  end(Phase::Failed);
}

void RobotNode::disarm(const std::string& why) {
  // An idle node commands nothing: one that ran would leave its treads as they are.
  SWARMSMITH_ASSERT(phase_ == Phase::Armed, "a run that has begun is stopped, not called off");
  refused_ = why;
  run_.clear();
  driver_.end();
  phase_ = Phase::Idle;
}

void RobotNode::set_log_trouble(std::string why) {
  log_trouble_ = std::move(why);
}

void RobotNode::lose_log() {
  log_lost_ = true;
  end(Phase::Failed);
}

void RobotNode::judge() {
  // Computed anew from the counters each time, so that the order of events does not matter. The
  // worst reason decides; the limits are those of docs/robot-runtime.md, "When it stops".
  verdict_ = RunVerdict::Valid;
  reasons_.clear();
  const auto add = [this](RunVerdict verdict, std::string reason) {
    verdict_ = std::max(verdict_, verdict);
    reasons_.push_back(std::move(reason));
  };
  if (!broken_.empty()) add(RunVerdict::Invalid, broken_);
  if (log_lost_) add(RunVerdict::Invalid, "the log is incomplete: " + log_trouble_);
  // Not in lock-step: there the world decides how many cycles a run has.
  if (clock_ && clock_->cycles() > 0) {
    SWARMSMITH_ASSERT(held_ + skipped_ <= clock_->cycles(), "no cycle comes after the last one");
    const double share = static_cast<double>(skipped_) / static_cast<double>(clock_->cycles());
    if (share > kDegraded) {
      add(share > kInvalid ? RunVerdict::Invalid : RunVerdict::Degraded,
          fmt::format("{} of {} cycles were skipped: the computer was too busy", skipped_,
                      clock_->cycles()));
    }
  }
  for (const Feed feed : kAllFeeds) {
    const std::size_t i = index_of(feed);
    if (held_for_[i] == 0) continue;
    add(RunVerdict::Degraded, fmt::format("{} was silent for up to {:.2f} s: {} not stepped",
                                          name_of(feed), seconds_of(longest_silence_[i]),
                                          counted(held_for_[i], "cycle was", "cycles were")));
  }
  for (const Standing* standing : {&by_driver_, &by_operator_}) {
    // If the driver has ended the run, `broken_` already has this reason.
    if (standing->cycles == 0 || (standing == &by_driver_ && driver_failed_)) continue;
    add(RunVerdict::Degraded,
        fmt::format("{}, for up to {:.2f} s, at {:.1f} s: {} not stepped", standing->what,
                    seconds_of(standing->longest), standing->at_s,
                    counted(standing->cycles, "cycle was", "cycles were")));
  }
  // A simulated world in lock-step has no driver that could disobey.
  if (clock_ && !lock_step_) {
    for (const std::string& doubt : driver_.doubts())
      add(RunVerdict::Degraded, "driver: " + doubt);
  }
  for (const std::string& step : clock_steps_)
    // Runs follow the steady clock, so a step is recorded but does not lower the verdict.
    add(RunVerdict::Valid, step);
  if (cut_ > 0) {
    add(RunVerdict::Degraded,
        fmt::format("speeds were cut to {} m/s in {}", settings_.max_mps, counted(cut_, "cycle")));
  }
}

}  // namespace swarmsmith
