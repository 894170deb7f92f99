#include "robot/app/node_loop.h"

#include <fmt/format.h>

#include <chrono>
#include <utility>

#include "base/overloaded.h"

namespace swarmsmith {
namespace {

constexpr Duration kTellEvery = std::chrono::milliseconds(500);
/// Limit of the messages that are taken after a deadline, so that a flood of messages cannot keep
/// the node from its cycle.
constexpr int kMostBehindDeadline = 64;
constexpr Duration kFlush = std::chrono::milliseconds(500);
constexpr Duration kLastLog = std::chrono::seconds(10);

TimePoint steady_now() {
  return SystemClock().now();
}

}  // namespace

Now now_on_both_clocks() {
  const std::chrono::duration<double> wall = std::chrono::system_clock::now().time_since_epoch();
  return {steady_now(), wall.count()};
}

NodeLoop::NodeLoop(RobotNode& node, RobotEnd& end, LoopOptions options)
    : node_(node), end_(end), options_(std::move(options)) {}

NodeLoop::Ending NodeLoop::run() {
  const Now now = now_on_both_clocks();
  set_wall_offset(now);
  world_heard_ = now.clock;
  while (turn()) {
  }
  close();
  if (ending_ == Ending::NoMoreRuns && node_.phase() == Phase::Failed) return Ending::Wrong;
  return *ending_;
}

/// Set each time, because the wall clock may be stepped.
void NodeLoop::set_wall_offset(const Now& now) {
  node_.feeds().set_wall_offset(duration_of(now.unix_s) - now.clock.time_since_epoch());
}

bool NodeLoop::turn() {
  if (auto why = options_.ends()) {
    node_.stop(*why);
    finish(Ending::Asked);
    return false;
  }
  if (options_.pace == Pace::Clock) return turn_by_clock();
  return turn_in_lock_step();
}

bool NodeLoop::turn_by_clock() {
  const TimePoint deadline = node_.next_tick(steady_now());
  int behind = 0;
  while (const auto message = end_.receive(deadline)) {
    hear(*message);
    if (ending_) return false;
    if (steady_now() >= deadline && ++behind >= kMostBehindDeadline) break;
  }
  node_.driver().set_listeners(end_.listeners(), steady_now());
  const Now now = now_on_both_clocks();
  set_wall_offset(now);
  carry_out(node_.tick(now));
  tend_log();
  tell_state(false);
  return true;
}

bool NodeLoop::turn_in_lock_step() {
  constexpr Duration kSlice = std::chrono::milliseconds(100);  // `ends` is called at least this
                                                               // often
  const TimePoint now = steady_now();
  if (const auto message = end_.receive(now + kSlice)) {
    world_heard_ = steady_now();
    hear(*message);
  } else {
    if (node_.is_on() && steady_now() - world_heard_ > options_.patience) {
      const std::string why = fmt::format("no message from the world for {:.1f} s",
                                          seconds_of(steady_now() - world_heard_));
      node_.fail(why);
      options_.note(why);
      finish(Ending::Lost);
    }
    tell_state(false);
  }
  tend_log();
  return !ending_;
}

void NodeLoop::hear(const ToRobot& message) {
  std::visit(Overloaded{[this](const OrderMessage& order) { hear_order(order); },
                        [this](const SensesMessage& senses) {
                          if (options_.pace == Pace::Senses) answer(senses);
                        },
                        [this](const TroubleMessage& trouble) {
                          if (trouble.text != last_trouble_) options_.note(trouble.text);
                          last_trouble_ = trouble.text;
                          if (!trouble.ended) return;
                          node_.fail(trouble.text);
                          finish(Ending::Lost);
                        },
                        [this](const BatteryMessage& battery) { node_.hear(battery); },
                        [this](const DrivenMessage& driven) { node_.driver().hear(driven); },
                        [this](const RivalMessage& rival) { node_.driver().hear(rival); },
                        [this](const auto& reading) {
                          node_.feeds().hear(reading);
                          if (options_.pace == Pace::CountedTopics) step_counted();
                        }},
             message);
}

void NodeLoop::hear_order(const OrderMessage& message) {
  const auto order = parse_order(message.text);
  if (!order) {
    if (order.error().message != last_refused_) options_.note(order.error().message);
    last_refused_ = order.error().message;
    node_.refuse_order(order.error().message);
    tell_state(true);
    return;
  }
  if (!order->unknown_keys.empty() && order->unknown_keys != last_unknown_) {
    last_unknown_ = order->unknown_keys;
    options_.note("an order " + std::string(name_of(order->kind)) + " has the unknown key " +
                  order->unknown_keys + ", which is ignored");
  }
  const bool was_on = node_.is_on();
  node_.hear(*order, now_on_both_clocks());
  if (!was_on && node_.is_on()) open_log();
  if (was_on && !node_.is_on())
    end_.send(WheelsMessage{});  // immediately, not only at the next
                                 // tick
  if (order->kind != Order::Kind::Alive) tell_state(true);
}

void NodeLoop::answer(const SensesMessage& senses) {
  const Now now = now_on_both_clocks();
  if (senses.cycle <= 1) {  // the previous run is over
    if (senses.cycle == 0) static_cast<void>(node_.answer(senses, now));
    if (senses.cycle == 1 && node_.is_on()) node_.end_run();
    tend_log();
    if (senses.cycle == 0) {
      end_.send(AnswerMessage{.seed = senses.seed});  // the world waits for this answer
      finish(node_.phase() == Phase::Failed ? Ending::Wrong : Ending::NoMoreRuns);
      return;
    }
  }
  auto decision = node_.answer(senses, now);
  if (!decision) {
    options_.note(decision.error().message);
    finish(Ending::Wrong);
    return;
  }
  if (senses.cycle == 1) open_log();
  const Command& command = *decision->command;
  end_.send(AnswerMessage{.seed = senses.seed,
                          .cycle = senses.cycle,
                          .left_mps = command.left_mps,
                          .right_mps = command.right_mps,
                          .state = decision->state});
  decision->command.reset();
  carry_out(std::move(*decision));
}

bool NodeLoop::all_heard(std::int64_t count) const {
  bool any = false;
  for (const Feed feed : kAllFeeds) {
    const std::int64_t heard = node_.feeds().heard(feed);
    if (node_.needed()[index_of(feed)] && heard < count) return false;
    any |= heard >= count;
  }
  return any;
}

void NodeLoop::step_counted() {
  const Now now = now_on_both_clocks();
  const std::int64_t cycle = node_.is_on() ? node_.cycle() + 1 : 1;
  if (node_.phase() == Phase::Failed || !all_heard(cycle)) return;
  if (cycle == 1) {
    node_.begin_counted(now);
    open_log();
  }
  carry_out(node_.step_counted(now));
}

void NodeLoop::carry_out(Decision decision) {
  if (decision.command) {
    WheelsMessage wheels{.left_mps = decision.command->left_mps,
                         .right_mps = decision.command->right_mps};
    if (options_.pace == Pace::CountedTopics) wheels.state = decision.state;
    end_.send(wheels);
    if (leds_ != decision.command->leds) {  // after the treads, and only on changes: LEDs share one
                                            // slow line
      LedsMessage message;
      std::size_t i = 0;
      for (const Rgb& led : decision.command->leds) {
        for (const std::uint8_t channel : {led.r, led.g, led.b})
          message.colors[i++] = channel;
      }
      end_.send(message);
      leds_ = decision.command->leds;
    }
  }
  if (decision.row && log_) log_->add(std::move(*decision.row));
}

void NodeLoop::open_log() {
  if (!options_.logs) return;
  if (log_) log_.reset();  // of the previous run; writes the remaining rows
  log_is_ending_ = false;
  const NodeState state = node_.state(now_on_both_clocks());
  auto opened = LogWriter::open(log_files_of(*options_.logs, state.run, state.robot), node_.head());
  if (opened) {
    log_ = std::move(*opened);
    node_.set_log_open(true);
    return;
  }
  const std::string why = "the log cannot be written: " + to_string(opened.error());
  options_.note(why);
  if (options_.pace == Pace::Clock) {
    node_.disarm(why);
  } else {
    node_.fail(why);
    finish(Ending::Wrong);
  }
}

void NodeLoop::tend_log() {
  if (!log_) return;
  const std::string trouble = log_->trouble();
  node_.set_log_trouble(trouble);
  if (!node_.is_on() && !log_is_ending_) {
    log_->finish(node_.head());
    log_is_ending_ = true;
  }
  if (!log_is_ending_ || !log_->is_done()) return;
  const std::string last = log_->trouble();
  node_.set_log_trouble(last);
  if (!last.empty()) {
    node_.lose_log();
    options_.note("the log is incomplete: " + last);
  }
  log_.reset();
  node_.set_log_open(false);
  node_.set_log_trouble({});
}

void NodeLoop::tell_state(bool at_once) {
  const Now now = now_on_both_clocks();
  const NodeState state = node_.state(now);
  std::string part = std::string(name_of(state.phase)) + "\n" + state.run + "\n" + state.order +
                     "\n" + state.refused + "\n" + state.log_trouble + "\n" +
                     std::to_string(static_cast<int>(state.verdict)) + (state.log_open ? "o" : "");
  if (!at_once && part == told_ && now.clock - told_at_ < kTellEvery) return;
  told_ = std::move(part);
  told_at_ = now.clock;
  end_.send(StateMessage{.text = state_text(state)});
}

void NodeLoop::close() {
  if (options_.pace != Pace::Senses) {
    end_.send(WheelsMessage{});
    end_.send(LedsMessage{});
  }
  tend_log();
  if (log_) {
    const TimePoint until = steady_now() + kLastLog;
    while (log_ && steady_now() < until) {
      log_->wait_done(until);
      tend_log();
    }
  }
  tell_state(true);
  end_.flush(kFlush);
}

}  // namespace swarmsmith
